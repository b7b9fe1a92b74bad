/** From a failure of the report to the place in the plan. */

import { batch } from "@preact/signals";
import type { Schemas } from "verne-client";
import { pass } from "../state/history";
import { moveTo } from "../state/motion";
import { change } from "../state/store";
import { seekRow } from "./player";
import { plan, settings } from "./program_state";
import { changed } from "./settings";
import { rowOfLine } from "./timeline";
import type { RowColumns } from "./row_columns";

type Failure = Schemas["ToolpathFailure"];

/** Moves the machine to the worst place of a failure, or to the last one before it that the machine reaches. */
export function goToFailure({ at, lines }: Failure): void {
  const rows = plan.peek()?.rows;
  if (!rows) return;
  seekRow(at.joints ? nearestRow(rows, at) : lastRowBefore(rows, lines[0] ?? at.line));
  const { x, y, z, phi1, phi2, joints, tool_length: tool } = at;
  const [a, b, c] = joints?.rho ?? [];
  const { theta1, theta2 } = joints ?? {};
  if (a === undefined || b === undefined || c === undefined || theta1 == null || theta2 == null) {
    // The service says why, and the scene marks the place.
    moveTo({ by: "part", pose: { x, y, z, phi1, phi2 } });
    return;
  }
  const there = { rho: [a, b, c] as [number, number, number], theta1, theta2 };
  pass(there);
  batch(() => {
    change({ tool, joints: there, mode: null });
    moveTo({ by: "joints", joints: there, mode: null });
  });
}

/** Changes the set-up or the tool as the report proposes; the program is then planned again. */
export function heal({ change: proposed, at }: Failure): void {
  if (proposed) settings.value = changed(settings.peek(), proposed, at.tool_length);
}

/** Lets the tool leave the part where the table is at the end of its range. */
export function rewind(): void {
  settings.value = { ...settings.peek(), onLimit: "retract" };
}

function nearestRow({ count, line, tip }: RowColumns, at: Failure["at"]): number {
  let [best, least] = [0, Infinity];
  for (let row = 0; row < count; row += 1) {
    if (line[row] !== at.line) continue;
    const way = Math.hypot(
      (tip[3 * row] ?? 0) - at.x,
      (tip[3 * row + 1] ?? 0) - at.y,
      (tip[3 * row + 2] ?? 0) - at.z,
    );
    if (way < least) [best, least] = [row, way];
  }
  return best;
}

function lastRowBefore(rows: RowColumns, line: number): number {
  return Math.max(rowOfLine(rows, line - 1), 0);
}
