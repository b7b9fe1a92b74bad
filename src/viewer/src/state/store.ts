/** What the page knows, as signals: panels and scene follow them. */

import { computed, signal } from "@preact/signals";
import type { Machine, MachineRef, Schemas, Slice, Solution, WorkspaceSummary } from "verne-client";
import type { Failure } from "../api/client";
import type { FieldFaults } from "../api/faults";
import type { Home } from "../words/margins";
import type { Target } from "./target";
import { INITIAL, type Joints, type View } from "./view";

/** The machine in use. */
export interface InUse {
  /** How requests name it. */
  ref: MachineRef;
  definition: Machine;
  hash: string;
  home: Home & { joints: Joints };
}

/** A position of the machine. */
export interface Position {
  joints: Joints;
  solution: Solution;
  /** What the service did not check for it. */
  notChecked: Schemas["Unchecked"][];
}

/** Where the machine was wanted and cannot be. */
export interface Refusal {
  target: Target;
  sentence: string;
  /** What the service says about single fields of the target. */
  fields: FieldFaults;
}

export interface Computing {
  /** 0 to 1; null before the first report. */
  progress: number | null;
  state: "waiting" | "queued" | "running";
  /** The id of its job, once there is one. */
  job: string | null;
}

export interface Surface {
  name: string;
  rgb: [number, number, number];
  /** Part of the whole surface. */
  share: number;
}

export const view = signal<View>(INITIAL);
/** Parts of the view: who needs one is not woken by the others. */
export const wanted = computed(() => view.value.workspace);
export const tool = computed(() => view.value.tool);
/** The tool's radius and the height over the table that is asked for, as requests have them. */
export const overTable = computed(() => ({
  table_clearance: view.value.clearance ?? machine.value?.definition.limits.table_clearance ?? 0,
  tool_radius: view.value.radius,
}));
export const section = computed(() => view.value.section);
export const drag = computed(() => view.value.drag);
export const ghostKind = computed(() => view.value.ghosts);
export const camera = computed(() => view.value.camera);

/** Whether what the first address asks for has been found, or has failed: before, there is nothing to draw. */
export const followed = signal(false);
export const published = signal<Schemas["MachineEntry"][]>([]);
export const machine = signal<InUse | null>(null);
export const position = signal<Position | null>(null);
export const ghosts = signal<Position[]>([]);
/** Where the machine is going: the newest target, until it is answered. */
export const heading = signal<Target | null>(null);
export const refusal = signal<Refusal | null>(null);
/** The joints that controls show: those that are wanted, where joints are wanted, or those where the machine stands. */
export const wantedJoints = computed(() => {
  const target = heading.value ?? refusal.value?.target;
  if (target?.by === "joints") return target.joints;
  return position.value?.joints ?? machine.value?.home.joints ?? null;
});

/** The tool's angles on the part for which a workspace is wanted, degrees; null while it is not known where it stands. */
export const workspaceAngles = computed(() => {
  const { joints, workspace } = view.value;
  const { follows, phi1, phi2 } = workspace;
  if (!follows) return { phi1, phi2 };
  const part = position.value?.solution.part;
  // At home, without joints of a link, both are zero: nobody waits for the answer.
  if (!part && joints) return null;
  return { phi1: thousandth(part?.phi1 ?? 0), phi2: thousandth(part?.phi2 ?? 0) };
});

/** The last workspace that was computed; `outdated` tells whether another one is wanted. */
export const workspace = signal<WorkspaceSummary | null>(null);
/** A coarser mesh of the same workspace, for slow machines while the hand moves. */
export const standIn = signal<WorkspaceSummary | null>(null);
/** Whether pictures of a moving scene cannot be drawn in time. */
export const slowDrawing = signal(false);
export const computing = signal<Computing | null>(null);
/** Why there is no workspace to see. */
export const workspaceNote = signal<string | null>(null);
export const surfaces = signal<Surface[]>([]);
/** The limit whose faces are pointed at, in the scene or in the legend, and the one that a click keeps. */
export const pointedLimit = signal<string | null>(null);
export const keptLimit = signal<string | null>(null);
/** The only limit whose faces are seen well; null: all. */
export const isolated = computed(() => pointedLimit.value ?? keptLimit.value);
export const slice = signal<Slice | null>(null);

/** A ghost that is pointed at or focused: its place in the list. */
export const pointed = signal<number | null>(null);
/** A failure that concerns the whole page. */
export const failure = signal<Failure | null>(null);
/** What a link asked for and the page does not show. */
export const notice = signal<string | null>(null);

export function change(part: Partial<View>): void {
  view.value = { ...view.peek(), ...part };
}

export function changeWorkspace(part: Partial<View["workspace"]>): void {
  change({ workspace: { ...view.peek().workspace, ...part } });
}

/** Equal postures ask for equal workspaces. */
function thousandth(angle: number): number {
  return Math.round(angle * 1000) / 1000 + 0;
}
