/** Fewer points for a plot of many rows: the least and the greatest value of each bucket remain. */

import { lastAtOrBefore } from "./timeline";

export interface PlotPoints {
  x: number[];
  /** One list for each column. */
  y: number[][];
}

/**
 * The columns between two times, with at most about two points for each bucket of time. Both points of a bucket lie in
 * it: the one with the value that comes first has the earlier time.
 */
export function plotPoints(
  time: Float64Array,
  columns: readonly Float64Array[],
  [from, to]: readonly [number, number],
  buckets: number,
): PlotPoints {
  const first = Math.max(lastAtOrBefore(time, from), 0);
  const last = Math.min(lastAtOrBefore(time, to) + 1, time.length - 1);
  if (last - first + 1 <= 2 * buckets) return all(time, columns, first, last);
  const points: PlotPoints = { x: [], y: columns.map(() => []) };
  const width = (to - from) / buckets;
  let begin = first;
  while (begin <= last) {
    const bucket = Math.floor(((time[begin] ?? 0) - from) / width);
    let end = begin + 1;
    while (end <= last && Math.floor(((time[end] ?? 0) - from) / width) === bucket) end += 1;
    add(points, time, columns, begin, end);
    begin = end;
  }
  return points;
}

function add(
  points: PlotPoints,
  time: Float64Array,
  columns: readonly Float64Array[],
  from: number,
  to: number,
): void {
  points.x.push(time[from] ?? 0);
  if (to - from > 1) points.x.push(time[to - 1] ?? 0);
  columns.forEach((column, i) => {
    let [least, greatest] = [from, from];
    for (let row = from; row < to; row += 1) {
      if ((column[row] ?? 0) < (column[least] ?? 0)) least = row;
      if ((column[row] ?? 0) > (column[greatest] ?? 0)) greatest = row;
    }
    const [early, late] = least < greatest ? [least, greatest] : [greatest, least];
    points.y[i]?.push(column[early] ?? 0);
    if (to - from > 1) points.y[i]?.push(column[late] ?? 0);
  });
}

function all(time: Float64Array, columns: readonly Float64Array[], first: number, last: number): PlotPoints {
  return {
    x: [...time.subarray(first, last + 1)],
    y: columns.map((column) => [...column.subarray(first, last + 1)]),
  };
}

/** Intervals of time. */
export type Intervals = [number, number][];

/** When the worst margin is negative: from the row before the first negative one to the row after the last. */
export function failingTimes(time: Float64Array, fraction: Float64Array): Intervals {
  const found: Intervals = [];
  for (let row = 0; row < time.length; row += 1) {
    if ((fraction[row] ?? 0) >= 0) continue;
    const begin = Math.max(row - 1, 0);
    while (row + 1 < time.length && (fraction[row + 1] ?? 0) < 0) row += 1;
    found.push([time[begin] ?? 0, time[Math.min(row + 1, time.length - 1)] ?? 0]);
  }
  return found;
}
