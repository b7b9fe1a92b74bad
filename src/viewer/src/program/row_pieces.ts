/** Reads the rows of a tool path from the service, piece by piece. */

import { tableFromIPC } from "@uwdata/flechette";
import type { ToolpathReport } from "verne-client";
import { verne } from "../api/client";
import type { InUse } from "../state/store";
import { marginRange } from "./margin_range";
import {
  bucketSize,
  JOINTS,
  RowCollector,
  type NearestLimit,
  type Piece,
  type RowColumns,
  type RowKind,
} from "./row_columns";

/** Rows from which on a tool path is thinned, to about as many. */
export const MOST_ROWS = 200_000;

/** About the rows of a request. */
const PIECE = 65_536;

interface Reading {
  machine: InUse;
  signal: AbortSignal;
  /** Called with the fraction of the rows that have arrived. */
  progress: (fraction: number) => void;
}

/** All rows, or those that are kept of too many; and how many consecutive rows share a bucket. */
export async function readRows(
  report: ToolpathReport,
  reading: Reading,
): Promise<{ columns: RowColumns; bucket: number }> {
  const bucket = bucketSize(report.rows, MOST_ROWS);
  const collector = new RowCollector(report.rows, bucket);
  const step = Math.max(1, Math.floor(PIECE / bucket)) * bucket;
  for (let from = 0; from < report.rows; from += step) {
    const to = Math.min(from + step, report.rows);
    const path = `${report.links.rows}.arrow?from=${from}&to=${to}`;
    const bytes = await verne.file(path, { signal: reading.signal });
    collector.add(pieceOf(new Uint8Array(bytes), from, reading.machine));
    reading.progress(to / report.rows);
  }
  return { columns: collector.columns, bucket };
}

/** The columns of a stream of Apache Arrow whose first row has this number. */
export function pieceOf(bytes: Uint8Array, first: number, { definition, home }: InUse): Piece {
  const table = tableFromIPC(bytes);
  const count = table.numRows;
  const numbers = (name: string) => Float64Array.from(table.getChild(name).toArray() as ArrayLike<number>);
  const words = (name: string) => Array.from(table.getChild(name).toArray() as ArrayLike<string>);
  const [constraints, elements] = [words("constraint"), words("element")];
  const limits = new Map<string, { limit: NearestLimit; range: number }>();
  const nearest = constraints.map((constraint, row) => {
    const element = elements[row] ?? "";
    const name = `${constraint} ${element}`;
    let known = limits.get(name);
    if (!known) {
      const limit = { constraint, element } as NearestLimit;
      limits.set(name, (known = { limit, range: marginRange(limit, definition, home) }));
    }
    return known;
  });
  const margin = numbers("margin");
  const joints = JOINTS.map((joint) => [joint, numbers(joint)]);
  return {
    count,
    number: Uint32Array.from({ length: count }, (_, row) => first + row),
    line: Uint32Array.from(table.getChild("line").toArray() as ArrayLike<number>),
    kind: words("kind") as RowKind[],
    tip: interleaved(["x", "y", "z"].map(numbers), count),
    axis: interleaved(["i", "j", "k"].map(numbers), count),
    joints: Object.fromEntries(joints) as Piece["joints"],
    duration: durations(table.getChild("duration").toArray() as ArrayLike<number | null>),
    margin,
    fraction: margin.map((value, row) => value / (nearest[row]?.range ?? 1)),
    limit: nearest.map(({ limit }) => limit),
  };
}

function interleaved(columns: Float64Array[], count: number): Float64Array {
  const all = new Float64Array(3 * count);
  columns.forEach((column, i) => column.forEach((value, row) => (all[3 * row + i] = value)));
  return all;
}

function durations(values: ArrayLike<number | null>): Float64Array {
  return Float64Array.from(values, (value) => value ?? Number.NaN);
}
