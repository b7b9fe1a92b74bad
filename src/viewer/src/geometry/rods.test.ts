import { expect, test } from "vitest";
import { rods } from "./rods";
import { VERNE } from "../state/verne.fixture";

/** Answers of the service for the paper's Figs 5 and 6 and for home. */
const SOLUTIONS = [
  {
    rho: [287.7175172879297, 4.604016192214431, 94.24224573766014],
    pose: { x: -240, y: -86, z: 1000, alpha: 5.011081680829594 },
  },
  {
    rho: [674, 685, 250],
    pose: { x: -210.55758167341662, y: 376.4522629338956, z: 1316.4697304272177, alpha: -22.44292140644151 },
  },
  {
    rho: [674, 685, 250],
    pose: {
      x: -39.60299844831559,
      y: -252.04327762685378,
      z: -118.72266958911337,
      alpha: 157.62200945575844,
    },
  },
] as const;

test("every rod has its length wherever the service says that the machine stands", () => {
  const g = VERNE.geometry;
  const lengths = [g.L1, g.L2, g.L3];
  for (const { rho, pose } of SOLUTIONS) {
    for (const rod of rods(g, rho, pose)) {
      const length = rod.slider.distanceTo(rod.platform);
      expect(Math.abs(length - (lengths[rod.leg] ?? 0)), `${rod.name} at z = ${pose.z}`).toBeLessThan(1e-9);
    }
  }
});
