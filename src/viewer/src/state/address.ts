/** The view in the address, after the #: only what differs from the first view. */

import type { Machine, PlatformPose, WorkspaceKind } from "verne-client";
import { INITIAL, type Camera, type Ghosts, type Joints, type ProgramView, type View } from "./view";
import { packed, unpacked } from "./packed";

const KINDS: readonly WorkspaceKind[] = ["platform", "tool", "part"];
const GHOSTS: readonly Ghosts[] = ["none", "assembly", "platform", "inverse"];

export async function toAddress(view: View): Promise<string> {
  const { workspace: ws } = view;
  const base = INITIAL.workspace;
  const entries: [string, string | null][] = [
    ["machine", view.own || view.machine === INITIAL.machine ? null : view.machine],
    ["own", view.own && (await packed(view.own))],
    ["joints", view.joints && numbers([...view.joints.rho, view.joints.theta1, view.joints.theta2], 3)],
    ["mode", view.mode && numbers([view.mode.x, view.mode.y, view.mode.z, view.mode.alpha], 3)],
    ["tool", view.tool === INITIAL.tool ? null : String(view.tool)],
    ["radius", view.radius === INITIAL.radius ? null : String(view.radius)],
    ["clearance", view.clearance === null ? null : String(view.clearance)],
    ["drag", view.drag === INITIAL.drag ? null : view.drag],
    ["ghosts", view.ghosts === INITIAL.ghosts ? null : view.ghosts],
    ["workspace", !ws.shown ? "hidden" : ws.kind === base.kind ? null : ws.kind],
    ["kind", !ws.shown && ws.kind !== base.kind ? ws.kind : null],
    ["solid", ws.solid ? "1" : null],
    ["phi", ws.phi1 === 0 && ws.phi2 === 0 ? null : numbers([ws.phi1, ws.phi2], 3)],
    ["tolerance", ws.tolerance === base.tolerance ? null : String(ws.tolerance)],
    ["section", view.section === null ? null : numbers([view.section], 3)],
    ["program", view.program && (await packed(view.program))],
    ["camera", view.camera && numbers([...view.camera.eye, ...view.camera.target], 3)],
  ];
  const said = entries.filter((entry): entry is [string, string] => entry[1] !== null);
  return said.map(([name, value]) => `${name}=${encodeURIComponent(value).replaceAll("%2C", ",")}`).join("&");
}

/** What cannot be read is left as it is in the first view. */
export async function fromAddress(hash: string): Promise<View> {
  const said = new URLSearchParams(hash.replace(/^#/, ""));
  const list = (name: string, length: number) => read(said.get(name), length);
  const base = INITIAL.workspace;
  const shown = said.get("workspace") !== "hidden";
  const own = said.get("own");
  return {
    machine: said.get("machine") ?? INITIAL.machine,
    own: own === null ? null : ((await unpacked(own)) as Machine | null),
    joints: asJoints(list("joints", 5)),
    mode: asPose(list("mode", 4)),
    tool: positive(list("tool", 1)?.[0], INITIAL.tool),
    radius: positive(list("radius", 1)?.[0], INITIAL.radius),
    clearance: positive(list("clearance", 1)?.[0], INITIAL.clearance),
    drag: oneOf(said.get("drag"), ["part", "tool"] as const, INITIAL.drag),
    ghosts: oneOf(said.get("ghosts"), GHOSTS, INITIAL.ghosts),
    workspace: {
      shown,
      solid: said.get("solid") === "1",
      kind: oneOf(said.get(shown ? "workspace" : "kind"), KINDS, base.kind),
      phi1: list("phi", 2)?.[0] ?? base.phi1,
      phi2: list("phi", 2)?.[1] ?? base.phi2,
      tolerance: positive(list("tolerance", 1)?.[0], base.tolerance),
    },
    section: list("section", 1)?.[0] ?? null,
    camera: asCamera(list("camera", 6)),
    program: await asProgram(said.get("program")),
  };
}

function numbers(values: number[], decimals: number): string {
  return values.map((value) => String(Number(value.toFixed(decimals)) + 0)).join(",");
}

function read(text: string | null, length: number): number[] | null {
  if (text === null) return null;
  const values = text.split(",").map((word) => (word.trim() === "" ? Number.NaN : Number(word)));
  return values.length === length && values.every(Number.isFinite) ? values : null;
}

function asJoints(list: number[] | null): Joints | null {
  if (!list) return null;
  const [r1, r2, r3, theta1, theta2] = list as [number, number, number, number, number];
  return { rho: [r1, r2, r3], theta1, theta2 };
}

function asPose(list: number[] | null): PlatformPose | null {
  if (!list) return null;
  const [x, y, z, alpha] = list as [number, number, number, number];
  return { x, y, z, alpha };
}

function asCamera(list: number[] | null): Camera | null {
  if (!list) return null;
  const [a, b, c, d, e, f] = list as [number, number, number, number, number, number];
  return { eye: [a, b, c], target: [d, e, f] };
}

async function asProgram(text: string | null): Promise<ProgramView | null> {
  const found = text === null ? null : ((await unpacked(text)) as Partial<ProgramView> | null);
  if (typeof found?.id !== "string" || typeof found.name !== "string") return null;
  return { id: found.id, name: found.name, settings: found.settings ?? {} };
}

function positive<T>(value: number | undefined, otherwise: T): number | T {
  return value !== undefined && value >= 0 ? value : otherwise;
}

function oneOf<T extends string>(word: string | null, words: readonly T[], otherwise: T): T {
  return words.find((known) => known === word) ?? otherwise;
}
