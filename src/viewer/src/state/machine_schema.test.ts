import { expect, test, vi } from "vitest";
import { fieldSchema, typeFaults, type Schema } from "./machine_schema";

vi.mock("../api/client", () => ({ verne: {} }));

const SCHEMA: Schema = {
  type: "object",
  required: ["name", "geometry", "limits"],
  additionalProperties: false,
  properties: {
    name: { type: "string" },
    geometry: {
      type: "object",
      required: ["L1", "L2"],
      additionalProperties: false,
      properties: { L1: { type: "number", description: "Rod length of leg I." }, L2: { type: "number" } },
    },
    limits: {
      type: "object",
      properties: {
        stroke: {
          type: "array",
          minItems: 3,
          maxItems: 3,
          items: { type: "array", minItems: 2, maxItems: 2, items: { type: "number" } },
        },
        rotary: { oneOf: [{ type: "array", items: { type: "number" } }, { type: "null" }] },
        table_clearance: { type: ["number", "null"] },
      },
    },
  },
};

test("all faults are found at once, each at its field", () => {
  const machine = {
    geometry: { L1: "long", L3: 4 },
    limits: { stroke: [[0, 750], [0, "750"], [0]], rotary: [true], table_clearance: null },
  };
  expect(typeFaults(machine, SCHEMA)).toEqual({
    name: "is missing",
    "geometry/L1": "must be a number, not a text",
    "geometry/L2": "is missing",
    "geometry/L3": "is no field of a machine",
    "limits/stroke/1/1": "must be a number, not a text",
    "limits/stroke/2": "must have 2 entries, not 1",
    "limits/rotary/0": "must be a number, not true or false",
  });
});

test("a machine without faults has none, and fields have their descriptions", () => {
  const limits = {
    stroke: [
      [0, 1],
      [0, 1],
      [0, 1],
    ],
    rotary: null,
  };
  expect(typeFaults({ name: "x", geometry: { L1: 1, L2: 2 }, limits }, SCHEMA)).toEqual({});
  expect(fieldSchema(SCHEMA, "geometry/L1")?.description).toBe("Rod length of leg I.");
  expect(fieldSchema(SCHEMA, "limits/stroke/0/1")?.type).toBe("number");
  expect(fieldSchema(SCHEMA, "geometry/none")).toBeNull();
});
