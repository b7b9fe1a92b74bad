/** The rows of a tool path in columns, and which of them are kept where there are too many. */

import type { Schemas } from "verne-client";

export type RowKind = Schemas["RowKindName"];

export const JOINTS = ["rho1", "rho2", "rho3", "theta1", "theta2"] as const;
export type Joint = (typeof JOINTS)[number];

/** The limit that is nearest to a row. */
export interface NearestLimit {
  constraint: Schemas["Constraint"];
  element: string;
}

/** Columns of equal length. Lengths are mm, angles degrees, times seconds. */
export interface RowColumns {
  count: number;
  /** The number of each row in the tool path, from 0. */
  number: Uint32Array;
  line: Uint32Array;
  kind: RowKind[];
  /** Tool's end and axis in the part frame: x, y, z of each row. */
  tip: Float64Array;
  axis: Float64Array;
  joints: Record<Joint, Float64Array>;
  /** Time since the row before it that is kept; NaN where the service knows none. */
  duration: Float64Array;
  /** The worst margin in the unit of its constraint, and as a fraction of the range of its limit. */
  margin: Float64Array;
  fraction: Float64Array;
  limit: NearestLimit[];
}

/** A piece of a tool path as the service sends it. */
export type Piece = RowColumns;

export function emptyColumns(capacity: number): RowColumns {
  const numbers = (each = 1) => new Float64Array(capacity * each);
  return {
    count: 0,
    number: new Uint32Array(capacity),
    line: new Uint32Array(capacity),
    kind: [],
    tip: numbers(3),
    axis: numbers(3),
    joints: { rho1: numbers(), rho2: numbers(), rho3: numbers(), theta1: numbers(), theta2: numbers() },
    duration: numbers(),
    margin: numbers(),
    fraction: numbers(),
    limit: [],
  };
}

/** Rows that a bucket keeps at most: its first, its last, and those with the extremes of six columns. */
export const KEPT_OF_BUCKET = 14;
/** Rows that a bucket usually keeps: extremes are often at its ends. */
const USUALLY_KEPT = 6;

/** How many consecutive rows make a bucket, if about `most` rows may be kept: 1 keeps all. */
export function bucketSize(rows: number, most: number): number {
  return rows <= most ? 1 : Math.ceil((rows * USUALLY_KEPT) / most);
}

/**
 * The rows of `from` to `to` that are kept: the first, the last, and those with the least and the greatest value of
 * each joint and of the margin. So a row that breaks a limit stays if it is the worst of its bucket.
 */
export function extremes(piece: Piece, from: number, to: number): number[] {
  const kept = new Set([from, to - 1]);
  for (const column of [piece.fraction, ...JOINTS.map((joint) => piece.joints[joint])]) {
    let [least, greatest] = [from, from];
    for (let row = from; row < to; row += 1) {
      const value = column[row] ?? 0;
      if (value < (column[least] ?? 0)) least = row;
      if (value > (column[greatest] ?? 0)) greatest = row;
    }
    kept.add(least).add(greatest);
  }
  return [...kept].sort((a, b) => a - b);
}

/** Collects pieces and keeps the extremes of each bucket. */
export class RowCollector {
  readonly columns: RowColumns;
  /** Time of rows that were left out since the last one that was kept. */
  private waiting = 0;

  constructor(
    rows: number,
    readonly bucket: number,
  ) {
    const buckets = Math.ceil(rows / bucket);
    this.columns = emptyColumns(bucket === 1 ? rows : Math.min(rows, buckets * KEPT_OF_BUCKET));
  }

  /** Adds the rows that follow. Their number is a multiple of the bucket, except at the end. */
  add(piece: Piece): void {
    for (let from = 0; from < piece.count; from += this.bucket) {
      const to = Math.min(from + this.bucket, piece.count);
      const kept = this.bucket === 1 ? [from] : extremes(piece, from, to);
      let next = from;
      for (const row of kept) {
        for (; next < row; next += 1) this.waiting += known(piece.duration[next]);
        this.push(piece, row);
        next = row + 1;
      }
    }
  }

  private push(piece: Piece, row: number): void {
    const { columns } = this;
    const at = columns.count;
    columns.number[at] = piece.number[row] ?? 0;
    columns.line[at] = piece.line[row] ?? 0;
    columns.kind.push(piece.kind[row] ?? "feed");
    for (let i = 0; i < 3; i += 1) {
      columns.tip[3 * at + i] = piece.tip[3 * row + i] ?? 0;
      columns.axis[3 * at + i] = piece.axis[3 * row + i] ?? 0;
    }
    for (const joint of JOINTS) columns.joints[joint][at] = piece.joints[joint][row] ?? 0;
    const own = piece.duration[row] ?? Number.NaN;
    columns.duration[at] = this.waiting > 0 ? this.waiting + known(own) : own;
    this.waiting = 0;
    columns.margin[at] = piece.margin[row] ?? 0;
    columns.fraction[at] = piece.fraction[row] ?? 0;
    columns.limit.push(piece.limit[row] ?? { constraint: "stroke", element: "" });
    columns.count += 1;
  }
}

function known(duration: number | undefined): number {
  return duration === undefined || Number.isNaN(duration) ? 0 : duration;
}
