import { expect, test } from "vitest";
import { areaInWords, pointsInWords, solutionsInWords } from "./atlas_words";

test("numbers of solutions are words, and so are special points", () => {
  expect([0, 1, 4].map(solutionsInWords)).toEqual(["no solution", "1 solution", "4 solutions"]);
  const cusp = { kind: "cusp" as const, at: [0, 0] };
  expect(pointsInWords([cusp, { ...cusp, kind: "self_motion" }, cusp])).toBe(
    "2 cusps, 1 point of self-motion",
  );
});

test("the printed interval contains every area that the error allows", () => {
  for (const area of [123456.7, 812345.04, 99])
    for (const error of [0, 0.5, 149.9, 20000]) {
      const [shown = 0, bound = 0] =
        areaInWords({ area, error })
          .replaceAll("\u202f", "")
          .match(/[\d.]+/g)
          ?.map(Number) ?? [];
      expect(Math.abs(shown * 1e6 - area) + error).toBeLessThanOrEqual(bound * 100 + 1e-6);
    }
});
