import { expect, test } from "vitest";
import type { Margins } from "verne-client";
import { VERNE } from "../state/verne.fixture";
import { reasonOf } from "./limits";
import { bars } from "./margins";

const HOME = { det: 1.180707104129615, rodDistance: 140.69474523900485 };

const AT_HOME: Margins = {
  stroke: [
    [448.6, 301.4],
    [746.9, 3.1],
    [495.6, 254.4],
  ],
  leg_length: [901.4, 854.4, 854.4],
  serial_singularity: [0.758, 0.758, 0.714, 0.714, 0.714, 0.714],
  parallel_singularity: 1.13,
  slider_joint: [42, 42, 41, 41, -1.25, -1.25],
  platform_joint: [32, 32, 32, 32, 32, 32],
  rod_crossing: 200,
  rod_interference: 90.7,
  tilt: [90, 90],
  rotary: [360, 360],
  worst: { constraint: "slider_joint", value: -1.25, unit: "deg", element: "rod31" },
};

test("worst first, by the part of each constraint's range, in an operator's words", () => {
  const found = bars(AT_HOME, VERNE, HOME);
  expect(found[0]?.sentence).toBe("rods 31, 32 bent 1.3° too far at the slider");
  // z points down: the greatest rho is the lower end.
  expect(found[1]?.sentence).toBe("slider 2 is 3.1\u00a0mm from its lower end");
  expect(found[1]?.part).toBeCloseTo(3.1 / 750, 12);
  const parts = found.map((bar) => bar.part);
  expect(parts).toEqual([...parts].sort((a, b) => a - b));
});

test("the first bar is what the service calls the worst", () => {
  expect(bars(AT_HOME, VERNE, HOME)[0]).toMatchObject({
    constraint: "slider_joint",
    element: "rod31",
    value: -1.25,
  });
});

test("the height over the table is a margin, measured by the longest stroke", () => {
  const at = (value: number, element: string) => ({
    ...AT_HOME,
    table_clearance: { constraint: "table_clearance", value, unit: "mm", element } as const,
  });
  const low = bars(at(-327.25, "tool"), VERNE, HOME)[0];
  expect(low?.sentence).toBe("the tool’s end 327.3\u00a0mm too low over the table");
  expect(low?.part).toBeCloseTo(-327.25 / 750, 12);
  const high = bars(at(45, "joint12"), VERNE, HOME).find((bar) => bar.constraint === "table_clearance");
  expect(high?.sentence).toBe("platform joint 12 can come 45.0\u00a0mm nearer to the table");
});

test("a question without an answer says why", () => {
  const machine = { name: "verne", hash: "" };
  const constraint = { constraint: "stroke", value: -395.6, unit: "mm", element: "slider2.max" } as const;
  const not_checked = ["part", "fixtures"] as const;
  expect(
    reasonOf({ machine, solutions: [], not_checked: [...not_checked], reason: "infeasible", constraint }),
  ).toBe("Out of reach: slider 2 395.6\u00a0mm beyond its lower end.");
});
