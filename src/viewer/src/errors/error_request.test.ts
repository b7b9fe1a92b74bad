import { expect, test } from "vitest";
import { errorRequest, groupsOf, PARAMETERS } from "./error_request";
import { bandsOf } from "./error_words";

const common = {
  machine: "verne",
  kind: "part",
  toolLength: 50,
  angles: { phi1: 5, phi2: 30 },
  overTable: { table_clearance: 0, tool_radius: 3 },
} as const;
const tolerances = { rods: 0.02, sliders: 0, joints: 0, axes: 0.05, angles: 0.001 };

test("each parameter of a group has its tolerance; groups without one are left out", () => {
  const { rods, axes, angles } = PARAMETERS;
  const named = errorRequest(common, tolerances)?.parameter_tolerances ?? {};
  expect(Object.keys(named).sort()).toEqual([...rods, ...axes, ...angles].sort());
  expect([named.L2, named.dt, named.tilt_zero]).toEqual([0.02, 0.05, 0.001]);
});

test("no parameter is in two groups, and the table has an effect on the part only", () => {
  const all = Object.values(PARAMETERS).flat();
  expect(new Set(all).size).toBe(all.length);
  expect(groupsOf("tool")).not.toContain("axes");
  const request = errorRequest({ ...common, kind: "platform" }, tolerances);
  expect(request).toMatchObject({ kind: "platform", parameter_tolerances: { L1: 0.02, L2: 0.02, L3: 0.02 } });
  expect(request).not.toHaveProperty("tool_length");
  expect(errorRequest({ ...common, kind: "tool" }, { ...tolerances, rods: 0 })).toBeNull();
});

test("bands have the ends that their names state, the largest errors first", () => {
  const palette = [
    { name: "axis_rms 0.0100 to 0.0200 deg", rgb: [0, 34, 78] as [number, number, number] },
    { name: "tip_worst 0.02 to 0.03 mm", rgb: [254, 232, 56] as [number, number, number] },
  ];
  expect(bandsOf({ palette })).toEqual([
    { name: "0.02 to 0.03\u00a0mm", colour: "rgb(254 232 56)" },
    { name: "0.0100 to 0.0200°", colour: "rgb(0 34 78)" },
  ]);
});
