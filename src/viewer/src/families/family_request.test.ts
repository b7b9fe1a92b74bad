import { expect, test } from "vitest";
import { familyRequest, faultOf, parametersOf, valuesOf, type Common } from "./family_request";

const common: Common = {
  machine: "verne",
  kind: "part",
  tolerance: 1,
  toolLength: 50,
  angles: { phi1: 5, phi2: 30 },
  overTable: { table_clearance: 0, tool_radius: 3 },
};

test("a range has both ends, ascending, and no value twice", () => {
  expect(valuesOf({ from: 0, to: 300, count: 4 })).toEqual([0, 100, 200, 300]);
  expect(valuesOf({ from: 20, to: -20, count: 3 })).toEqual([-20, 0, 20]);
  expect(valuesOf({ from: 0, to: 0.002, count: 5 })).toEqual([0, 0.001, 0.002]);
  expect(faultOf({ from: 1, to: 1, count: 5 })).toMatch(/at least two values/);
  expect(faultOf({ from: 1, to: 0, count: 5 })).toBeNull();
});

test("the parameter replaces the value of the page, and nothing else changes", () => {
  const range = { from: 0, to: 10, count: 2 };
  const shared = {
    machine: "verne",
    kind: "part",
    tolerance: 1,
    phi2: 30,
    table_clearance: 0,
    tool_radius: 3,
  };
  expect(familyRequest(common, "tool_length", range)).toEqual({ ...shared, tool_length: [0, 10], phi1: 5 });
  expect(familyRequest(common, "phi1", range)).toEqual({ ...shared, tool_length: 50, phi1: [0, 10] });
});

test("a request names only what has an effect on its kind", () => {
  expect(parametersOf("platform")).toEqual([]);
  expect(parametersOf("tool")).toEqual(["tool_length"]);
  const request = familyRequest({ ...common, kind: "tool" }, "tool_length", { from: 0, to: 1, count: 2 });
  expect(request).toEqual({ machine: "verne", kind: "tool", tolerance: 1, tool_length: [0, 1] });
});
