/** The request for a family: one workspace for each value of one parameter. */

import type { MachineRef, WorkspaceKind, WorkspaceRequest } from "verne-client";
import type { FamilyParameter, ValueRange } from "../state/view";

/** The settings of the page that all members of a family have in common. */
export interface Common {
  machine: MachineRef;
  kind: WorkspaceKind;
  tolerance: number;
  toolLength: number;
  /** The tool's angles on the part, degrees. */
  angles: { phi1: number; phi2: number };
  overTable: { table_clearance: number; tool_radius: number };
}

/** The parameters that change the workspace of a kind. */
export function parametersOf(kind: WorkspaceKind): readonly FamilyParameter[] {
  if (kind === "platform") return [];
  return kind === "tool" ? ["tool_length"] : ["tool_length", "phi1"];
}

/** The values of a range in ascending order, rounded to a thousandth as the page's own angles are. */
export function valuesOf({ from, to, count }: ValueRange): number[] {
  const [least, greatest] = from < to ? [from, to] : [to, from];
  const values = Array.from({ length: count }, (_, i) => least + ((greatest - least) * i) / (count - 1));
  return [...new Set(values.map((value) => Math.round(value * 1000) / 1000 + 0))];
}

/** Why a family of a range cannot be computed; null if it can be. */
export function faultOf({ from, to }: ValueRange): string | null {
  return from === to ? "The first and the last value are equal: a family needs at least two values." : null;
}

export function familyRequest(
  common: Common,
  parameter: FamilyParameter,
  range: ValueRange,
): WorkspaceRequest {
  const { machine, kind, tolerance, toolLength, angles, overTable } = common;
  const request: WorkspaceRequest = { machine, kind, tolerance, tool_length: toolLength };
  if (kind === "part") Object.assign(request, { ...angles, ...overTable });
  return { ...request, [parameter]: valuesOf(range) };
}
