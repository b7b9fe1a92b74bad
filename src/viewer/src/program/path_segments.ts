/** Which rows are joined by which kind of line. */

import type { Plan } from "./program_state";
import type { RowKind } from "./row_columns";

/** The rows to which the segments of each kind of line lead, from the row before. */
export interface Segments {
  feed: Uint32Array;
  rapid: Uint32Array;
  /** Those that break a limit; they are also among the others. */
  broken: Uint32Array;
}

const CUTS: readonly RowKind[] = ["feed", "inserted", "turn"];

export function segments({ rows, report }: Pick<Plan, "rows" | "report">): Segments {
  const [feed, rapid, broken]: number[][] = [[], [], []];
  const gaps = report.failures.filter(({ at }) => !at.joints).map(({ at }) => at.line);
  for (let row = 1; row < rows.count; row += 1) {
    const [from, to] = [rows.line[row - 1] ?? 0, rows.line[row] ?? 0];
    // The machine cannot reach a place between these rows: no line leads over it.
    if (gaps.some((line) => line > from && line <= to)) continue;
    (CUTS.includes(rows.kind[row] ?? "feed") ? feed : rapid)?.push(row);
    if ((rows.fraction[row] ?? 0) < 0 || (rows.fraction[row - 1] ?? 0) < 0) broken?.push(row);
  }
  return {
    feed: Uint32Array.from(feed ?? []),
    rapid: Uint32Array.from(rapid ?? []),
    broken: Uint32Array.from(broken ?? []),
  };
}
