/** Which rows are joined by which kind of line. */

import type { ToolpathReport } from "verne-client";
import type { RowColumns, RowKind } from "./row_columns";

/** The rows of a tool path and the report on it. */
interface Planned {
  rows: RowColumns;
  report: ToolpathReport;
}

/** The rows to which the segments of each kind of line lead, from the row before. */
export interface Segments {
  feed: Uint32Array;
  rapid: Uint32Array;
  /** Those that break a limit; they are also among the others. */
  broken: Uint32Array;
}

/** A place that the machine cannot reach: rows lead to it and go on behind it. */
export interface Gap {
  /** The last row before it, and the first one after it, if there are such rows. */
  before: number;
  after: number;
  at: [number, number, number];
}

const CUTS: readonly RowKind[] = ["feed", "inserted", "turn"];

export function segments({ rows, report }: Planned): Segments {
  const [feed, rapid, broken]: number[][] = [[], [], []];
  const ends = new Set(gaps({ rows, report }).map(({ after }) => after));
  for (let row = 1; row < rows.count; row += 1) {
    // The machine cannot reach a place between these rows: no line leads over it.
    if (ends.has(row)) continue;
    (CUTS.includes(rows.kind[row] ?? "feed") ? feed : rapid)?.push(row);
    if ((rows.fraction[row] ?? 0) < 0 || (rows.fraction[row - 1] ?? 0) < 0) broken?.push(row);
  }
  return {
    feed: Uint32Array.from(feed ?? []),
    rapid: Uint32Array.from(rapid ?? []),
    broken: Uint32Array.from(broken ?? []),
  };
}

/** Fewer segments, each in the place of up to `each` consecutive ones: the rows before and at their ends. */
export function longer(to: Uint32Array, each: number): { from: Uint32Array; to: Uint32Array } {
  const [starts, ends]: [number[], number[]] = [[], []];
  for (let i = 0; i < to.length;) {
    const first = to[i] ?? 0;
    let last = i;
    while (last + 1 < to.length && last + 1 - i < each && to[last + 1] === first + last + 1 - i) last += 1;
    starts.push(first - 1);
    ends.push(to[last] ?? 0);
    i = last + 1;
  }
  return { from: Uint32Array.from(starts), to: Uint32Array.from(ends) };
}

/** The failures at places that the machine cannot reach. */
export function gaps({ rows, report }: Planned): Gap[] {
  return report.failures
    .filter(({ at }) => !at.joints)
    .map(({ at, lines: [first = at.line] }) => {
      let after = 0;
      while (after < rows.count && (rows.line[after] ?? 0) < first) after += 1;
      return { before: after - 1, after, at: [at.x, at.y, at.z] };
    });
}
