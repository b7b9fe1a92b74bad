import { expect, test } from "vitest";
import { CLASSES, classOf, countsOf, layersOf } from "./reached_share";

const grid = { origin: [0, 0, -10], step: 10, counts: [2, 1, 3], turn: 0 };
/** (0,0,0): all of -20 to 20; (1,0,1): two intervals, 15 of 40 degrees. */
const cells = { grid, offsets: [0, 0, 1, 1, 1, 1, 3], intervals: [-20, 20, -20, -10, 0, 5] };

test("layers have the reached points only, with the class of their share", () => {
  const layers = layersOf(cells, 40);
  expect(layers).toEqual([
    { z: 0, points: [{ x: 0, y: 0, group: 4 }] },
    { z: 10, points: [{ x: 10, y: 0, group: 1 }] },
  ]);
  expect(countsOf(layers)).toEqual([0, 1, 0, 0, 1]);
});

test("the grid is turned about Z", () => {
  const [, upper] = layersOf({ ...cells, grid: { ...grid, turn: 90 } }, 40);
  expect(upper?.points[0]?.x).toBeCloseTo(0);
  expect(upper?.points[0]?.y).toBeCloseTo(10);
});

test("only the whole range belongs to the last class", () => {
  expect([0, 0.2, 0.25, 0.5, 0.75, 0.999, 1].map(classOf)).toEqual([0, 0, 1, 2, 3, 3, 4]);
  expect(classOf(1 - 1e-12)).toBe(4);
  expect(layersOf({ ...cells, intervals: [5, 5, 5, 5, 5, 5] }, 0)[0]?.points[0]?.group).toBe(
    CLASSES.length - 1,
  );
});
