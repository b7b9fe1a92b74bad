import { expect, test } from "vitest";
import { pointOf, sharesOf, slidersAt, solutionsAt, within } from "./atlas_plane";

const square = (size: number): number[][] => [
  [-size, -size],
  [size, -size],
  [size, size],
  [-size, size],
];
const frame = {
  solutions: 4,
  label: [8, 8],
  area: 300,
  area_error: 0.5,
  outer: square(10),
  holes: [square(5).reverse()],
};
const core = { solutions: 6, label: [0, 0], area: 100, area_error: 0.25, outer: square(5), holes: [] };
const regions = [frame, core, { ...core, area: 1 }];

test("a point is found in the region whose hole it is not in", () => {
  expect(solutionsAt([0, 0], { regions })).toBe(6);
  expect(solutionsAt([7, -3], { regions })).toBe(4);
  expect(solutionsAt([11, 0], { regions })).toBeNull();
});

test("every point is within exactly one of a face and its complement", () => {
  let random = 7;
  const next = () => (random = (random * 16807) % 2147483647) / 2147483647;
  for (let i = 0; i < 500; i += 1) {
    const point = [20 * next() - 10, 20 * next() - 10] as const;
    expect([frame, core].filter((face) => within(point, face))).toHaveLength(1);
  }
});

test("regions of equal numbers are one row, with the sum of their areas and errors", () => {
  expect(sharesOf({ regions })).toEqual([
    { solutions: 4, area: 300, error: 0.5 },
    { solutions: 6, area: 101, error: 0.5 },
  ]);
});

test("sliders are at the wanted point, within their strokes if they can be, and else slider 1 stays", () => {
  const limits = {
    stroke: [
      [0, 700],
      [50, 750],
      [0, 700],
    ],
  } as unknown as Parameters<typeof slidersAt>[2];
  const platform = { x: 0, y: 0, z: 0, alpha: 0 };
  for (const [u, v] of [
    [0, 0],
    [-300, 200],
    [699, -40],
    [100, 650],
  ] as const) {
    const rho = slidersAt([u, v], 680, limits);
    const [a, b] = pointOf("joints", { rho, theta1: 0, theta2: 0 }, platform);
    expect(a).toBeCloseTo(u, 9);
    expect(b).toBeCloseTo(v, 9);
    rho.forEach((value, i) => {
      expect(value).toBeGreaterThanOrEqual(limits.stroke[i]?.[0] ?? NaN);
      expect(value).toBeLessThanOrEqual(limits.stroke[i]?.[1] ?? NaN);
    });
  }
  expect(slidersAt([10, 20], 300, limits)).toEqual([300, 310, 320]);
  expect(slidersAt([800, 0], 300, limits)).toEqual([300, 1100, 300]);
});
