/** Points of a dexterity map by the share of the range of inclinations that reaches them. */

import type { Schemas } from "verne-client";

type Cells = Pick<Schemas["DexterityCells"], "grid" | "offsets" | "intervals">;

/** Classes of points, by the share of the range that reaches them. The colours grow lighter: colour-blind users can
 * order them. */
export const CLASSES = [
  { name: "less than a quarter", colour: "#482878" },
  { name: "a quarter to a half", colour: "#3e6a9e" },
  { name: "half to three quarters", colour: "#26a085" },
  { name: "three quarters, but not all", colour: "#7fd34e" },
  { name: "all inclinations", colour: "#fde725" },
] as const;

/** Relative room for the rounding of the ends of intervals. */
const ROUNDING = 1e-9;

/** A reached point of a layer. */
export interface ReachedPoint {
  /** In the part frame, mm. */
  x: number;
  y: number;
  /** Its place in `CLASSES`. */
  group: number;
}

/** The points at one height that some inclination reaches. */
export interface Layer {
  /** Height over the table, mm. */
  z: number;
  points: ReachedPoint[];
}

/** The class of a share, 0 to 1. */
export function classOf(share: number): number {
  return share >= 1 - ROUNDING ? CLASSES.length - 1 : Math.min(Math.floor(share * 4), CLASSES.length - 2);
}

/** The layers with reached points, from the lowest to the highest; `span` is the length of the range, degrees. */
export function layersOf({ grid, offsets, intervals }: Cells, span: number): Layer[] {
  const [columns = 0, rows = 0, heights = 0] = grid.counts;
  const [x0 = 0, y0 = 0, z0 = 0] = grid.origin;
  const turn = (grid.turn * Math.PI) / 180;
  const [cos, sin] = [Math.cos(turn), Math.sin(turn)];
  const layers = Array.from({ length: heights }, (_, k): Layer => ({ z: z0 + k * grid.step, points: [] }));
  for (let i = 0; i < columns; i += 1)
    for (let j = 0; j < rows; j += 1)
      for (const [k, layer] of layers.entries()) {
        const point = (i * rows + j) * heights + k;
        const [first = 0, end = 0] = [offsets[point], offsets[point + 1]];
        if (first === end) continue;
        const [x, y] = [x0 + i * grid.step, y0 + j * grid.step];
        const group = classOf(reached(intervals, first, end, span));
        layer.points.push({ x: cos * x - sin * y, y: sin * x + cos * y, group });
      }
  return layers.filter(({ points }) => points.length > 0);
}

/** The share of the range in the intervals from `first` up to `end`. A range of one inclination is reached entirely. */
function reached(intervals: readonly number[], first: number, end: number, span: number): number {
  if (span === 0) return 1;
  let sum = 0;
  for (let at = first; at < end; at += 1) sum += (intervals[2 * at + 1] ?? 0) - (intervals[2 * at] ?? 0);
  return sum / span;
}

/** The number of points of each class. */
export function countsOf(layers: readonly Layer[]): number[] {
  const counts = CLASSES.map(() => 0);
  for (const { points } of layers) for (const { group } of points) counts[group] = (counts[group] ?? 0) + 1;
  return counts;
}
