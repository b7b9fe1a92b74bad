import { expect, test } from "vitest";
import { azimuth, phi1Towards, phi2Towards, toolAxis } from "./orientation";

test("the angles come back from the tool's axis", () => {
  for (const [phi1, phi2] of [
    [20, 30],
    [-35, 110],
    [60, -250],
    [10, 359],
  ] as const) {
    expect(phi1Towards(toolAxis(phi1, phi2), phi2, phi1 + 5)).toBeCloseTo(phi1, 9);
    expect(phi2Towards(azimuth(phi2).multiplyScalar(120), phi2 - 40)).toBeCloseTo(phi2, 9);
  }
});
