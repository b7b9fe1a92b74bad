/** When the machine is at which row, and where it is between two rows. */

import { JOINTS, type Joint, type RowColumns } from "./row_columns";

/** Speeds of the picture where neither a feed nor a drive determines a time: mm/s of a slider, degrees/s of the table. */
export const ASSUMED_SPEED = { slider: 200, table: 60 };

/** A place on the way to a row. */
export interface Instant {
  /** The row that the machine leaves, and the fraction of the way to the next one. */
  row: number;
  fraction: number;
}

/** Seconds from the first row to each row. */
export function times(rows: RowColumns): Float64Array {
  const found = new Float64Array(rows.count);
  let now = 0;
  for (let row = 1; row < rows.count; row += 1) {
    const stated = rows.duration[row] ?? Number.NaN;
    now += Number.isNaN(stated) ? assumedDuration(rows, row) : stated;
    found[row] = now;
  }
  return found;
}

function assumedDuration({ joints }: RowColumns, row: number): number {
  return JOINTS.reduce((longest, joint) => {
    const way = Math.abs((joints[joint][row] ?? 0) - (joints[joint][row - 1] ?? 0));
    return Math.max(longest, way / (joint.startsWith("rho") ? ASSUMED_SPEED.slider : ASSUMED_SPEED.table));
  }, 0);
}

/** The place at a time. Where rows share a time, the last of them. */
export function instantAt(time: Float64Array, now: number): Instant {
  const last = time.length - 1;
  if (last < 1 || now >= (time[last] ?? 0)) return { row: Math.max(last, 0), fraction: 0 };
  const row = Math.max(lastAtOrBefore(time, now), 0);
  const [from, to] = [time[row] ?? 0, time[row + 1] ?? 0];
  return { row, fraction: to > from ? Math.max(now - from, 0) / (to - from) : 0 };
}

/** The last place of an ascending list whose value is at most this one, or -1. */
export function lastAtOrBefore(ascending: ArrayLike<number>, value: number): number {
  let [low, high] = [0, ascending.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((ascending[middle] ?? 0) <= value) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

/** The joints between two rows: they move linearly. */
export function jointsAt({ joints }: RowColumns, { row, fraction }: Instant): Record<Joint, number> {
  const at = (joint: Joint) => {
    const from = joints[joint][row] ?? 0;
    return from + fraction * ((joints[joint][row + 1] ?? from) - from);
  };
  return { rho1: at("rho1"), rho2: at("rho2"), rho3: at("rho3"), theta1: at("theta1"), theta2: at("theta2") };
}

/** The velocity of a joint on the way to each row; 0 where no time passes. */
export function rates(rows: RowColumns, time: Float64Array, joint: Joint): Float64Array {
  const values = rows.joints[joint];
  return Float64Array.from({ length: rows.count }, (_, row) => {
    const passed = row === 0 ? 0 : (time[row] ?? 0) - (time[row - 1] ?? 0);
    return passed > 0 ? ((values[row] ?? 0) - (values[row - 1] ?? 0)) / passed : 0;
  });
}

/** The row that ends the motion of a line; for a line without motion, of the last line before it. -1: none. */
export function rowOfLine({ line, count }: RowColumns, wanted: number): number {
  let best = -1;
  for (let row = 0; row < count; row += 1) {
    const at = line[row] ?? 0;
    if (at <= wanted && (best < 0 || at >= (line[best] ?? 0))) best = row;
  }
  return best;
}
