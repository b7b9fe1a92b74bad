/** The request for the errors of the tool: one tolerance for each group of parameters. */

import type { ErrorMapRequest, MachineRef, WorkspaceKind } from "verne-client";
import type { ErrorTolerances } from "../state/view";

type Group = keyof ErrorTolerances;
type Parameter = keyof ErrorMapRequest["parameter_tolerances"];

/** The parameters of each group, as the service names them. */
export const PARAMETERS: Readonly<Record<Group, readonly Parameter[]>> = {
  rods: ["L1", "L2", "L3"],
  sliders: ["o1", "o2", "o3"],
  joints: ["e1", "e2", "R1", "r1", "R2", "r4"],
  axes: ["da", "dt", "tilt_axis_y", "rotary_axis_x", "rotary_axis_y"],
  angles: ["tilt_axis_b", "tilt_axis_c", "tilt_zero", "rotary_axis_b", "rotary_zero"],
};

/** The groups that have an effect on a kind: only the part stands on the table. */
export function groupsOf(kind: WorkspaceKind): readonly Group[] {
  return kind === "part" ? ["rods", "sliders", "joints", "axes", "angles"] : ["rods", "sliders", "joints"];
}

/** Distance between the points of the grid, and of the mesh from the true surface, mm: the colours need no finer ones. */
const GRID = { cell: 50, tolerance: 10 };

export interface Common {
  machine: MachineRef;
  kind: WorkspaceKind;
  toolLength: number;
  /** The tool's angles on the part, degrees. */
  angles: { phi1: number; phi2: number };
  overTable: { table_clearance: number; tool_radius: number };
}

/** Null where no parameter has a tolerance. */
export function errorRequest(common: Common, tolerances: ErrorTolerances): ErrorMapRequest | null {
  const { machine, kind, toolLength, angles, overTable } = common;
  const stated = groupsOf(kind).filter((group) => tolerances[group] > 0);
  if (stated.length === 0) return null;
  const entries = stated.flatMap((group) =>
    PARAMETERS[group].map((name) => [name, tolerances[group]] as const),
  );
  return {
    machine,
    kind,
    ...(kind !== "platform" && { tool_length: toolLength }),
    ...(kind === "part" && { ...angles, ...overTable }),
    parameter_tolerances: Object.fromEntries(entries),
    ...GRID,
  };
}
