/** Margins as fractions of the ranges of their limits, which makes lengths and angles comparable. */

import type { Machine } from "verne-client";
import type { Home } from "../words/margins";
import type { NearestLimit } from "./row_columns";

/** The range of a limit, in the unit of its margin; as the service compares margins. */
export function marginRange({ constraint, element }: NearestLimit, machine: Machine, home: Home): number {
  const { geometry: g, limits } = machine;
  const width = ([low = 0, high = 0]: number[]) => high - low;
  const number = Number(/\d/.exec(element)?.[0] ?? 1) - 1;
  switch (constraint) {
    case "stroke":
      return width(limits.stroke[number] ?? []);
    case "leg_length":
      return [g.L1, g.L2, g.L3][number] ?? g.L1;
    case "serial_singularity":
      return 1;
    case "parallel_singularity":
      return Math.abs(home.det);
    case "slider_joint":
      return limits.slider_cone;
    case "platform_joint":
      return limits.platform_cone;
    case "rod_crossing":
      return g.R1 - g.r1 || g.R1;
    case "rod_interference":
      return home.rodDistance;
    case "tilt":
      return width(limits.tilt);
    case "rotary":
      return limits.rotary ? width(limits.rotary) : Infinity;
    case "table_clearance":
      return Math.max(...limits.stroke.map(width));
  }
}
