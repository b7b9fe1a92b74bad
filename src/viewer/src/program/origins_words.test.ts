import { expect, test } from "vitest";
import { regionHint, regionWords } from "./origins_words";

test("a region is said with its volume, the error and its bounds", () => {
  const bounds = { min: [-256.96, -539.4, 79], max: [254.5, 522.7, 647.9] };
  expect(regionWords({ volume: 139003785, volume_error: 3123999, bounds })).toBe(
    "The origin may be in the region that the scene shows: 139\u00a0litres (± 3.12\u00a0litres), within " +
      "x \u2212257 to 255, y \u2212539 to 523, z 79 to 648\u00a0mm.",
  );
});

test("an empty region is said to be empty, and what is not checked is named", () => {
  expect(regionWords({ volume: 0, volume_error: 0, bounds: null })).toMatch(/^No origin was found/);
  expect(regionHint(40)).toContain("a cell of 40\u00a0mm may be missing");
});
