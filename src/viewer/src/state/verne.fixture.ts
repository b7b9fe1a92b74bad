/** The built-in machine, as GET /machines/verne has it. For tests. */

import type { Machine } from "verne-client";

export const VERNE: Machine = {
  name: "verne",
  description:
    "Reference machine: round dimensions that reproduce the solution counts printed in arXiv:0707.3507. Not Fatronik's dimensions, which the paper does not give.",
  geometry: {
    D1: 100,
    d1: 600,
    D2: -100,
    d2: -600,
    R1: 275,
    r1: 75,
    R2: 150,
    r4: 500,
    L1: 1050,
    L2: 1050,
    L3: 1050,
    parallelogram_half_width: 80,
    rod_radius: 25,
  },
  table: {
    da: 1500,
    dt: 200,
  },
  limits: {
    stroke: [
      [0, 750],
      [0, 750],
      [0, 750],
    ],
    slider_cone: 42,
    platform_cone: 32,
    serial_margin: 0.1,
    parallel_margin: 0.05,
    tilt: [-90, 90],
    rotary: [-360, 360],
  },
};
