import { expect, test } from "vitest";
import { changed, DEFAULTS, initialSettings, toolpathRequest } from "./settings";

const OVER_TABLE = { table_clearance: 0, tool_radius: 3 };

test("the lengths that a program states are used if it states all of them", () => {
  expect(initialSettings([{ line: 4, number: 1, length: 120 }], 50).lengths).toBe("program");
  expect(initialSettings([{ line: 4, number: 1 }], 50).lengths).toBe(50);
  expect(initialSettings([], 50).lengths).toBe(50);
});

test("a request has the settings and the limits of the table", () => {
  const request = toolpathRequest("id", "verne", { ...DEFAULTS, lengths: { "1": 80 } }, OVER_TABLE);
  expect(request).toMatchObject({
    program: "id",
    tool_length: { "1": 80 },
    table_clearance: 0,
    tool_radius: 3,
  });
  expect(toolpathRequest("id", "verne", DEFAULTS, OVER_TABLE)).not.toHaveProperty("tool_length");
});

test("a change that heals is added to the number that it names", () => {
  expect(changed(DEFAULTS, { parameter: "setup.y", delta: -4 }, 100).setup.y).toBe(-4);
  expect(changed(DEFAULTS, { parameter: "tool_length", delta: 7 }, 100).lengths).toBe(107);
  const table = { ...DEFAULTS, lengths: { "1": 100, "2": 90 } };
  expect(changed(table, { parameter: "tool_length", delta: 7 }, 90).lengths).toEqual({ "1": 100, "2": 97 });
});
