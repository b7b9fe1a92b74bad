import { expect, test } from "vitest";
import { failingTimes, plotPoints } from "./plot_points";

test("few rows are all drawn, with those beside the shown times", () => {
  const time = Float64Array.from([0, 1, 2, 3, 4]);
  const points = plotPoints(time, [Float64Array.from([5, 6, 7, 8, 9])], [1.5, 2.5], 100);
  expect(points).toEqual({ x: [1, 2, 3], y: [[6, 7, 8]] });
});

test("of many rows, the extremes of each bucket are drawn", () => {
  const count = 100_000;
  const time = Float64Array.from({ length: count }, (_, row) => row / 100);
  const values = Float64Array.from({ length: count }, (_, row) => Math.sin(row / 300));
  values[54_321] = -9;
  values[77_777] = 9;
  const { x, y } = plotPoints(time, [values], [0, count / 100], 500);
  const drawn = y[0] ?? [];
  expect(x.length).toBe(drawn.length);
  expect(x.length).toBeLessThanOrEqual(2 * 500 + 2);
  expect(Math.min(...drawn)).toBe(-9);
  expect(Math.max(...drawn)).toBe(9);
  expect(x.every((at, i) => i === 0 || at >= (x[i - 1] ?? 0))).toBe(true);
  // In its bucket: within a five-hundredth of the time.
  expect(Math.abs((x[drawn.indexOf(-9)] ?? 0) - 543.21)).toBeLessThanOrEqual(count / 100 / 500);
});

test("a stretch fails from the row before the first broken limit to the row after the last", () => {
  const time = Float64Array.from([0, 1, 2, 3, 4, 5]);
  expect(failingTimes(time, Float64Array.from([1, -1, -2, 1, 1, -1]))).toEqual([
    [0, 3],
    [4, 5],
  ]);
  expect(failingTimes(time, Float64Array.from([1, 1, 1, 1, 1, 1]))).toEqual([]);
});
