import { expect, test } from "vitest";
import { DEFAULTS, ORIGIN, toolpathRequest } from "./settings";
import { hasOneLength, rangeAround, valueOf, withValue, without } from "./window_range";

const OVER_TABLE = { table_clearance: 0, tool_radius: 0 };

test("a value that is set is the value that is read", () => {
  for (const name of ["setup.x", "setup.c", "tool_length"] as const)
    expect(valueOf(name, withValue(name, DEFAULTS, 42), null)).toBe(42);
  expect(valueOf("tool_length", DEFAULTS, 120)).toBe(120);
});

test("the range contains the value, and no tool is shorter than nothing", () => {
  expect(rangeAround("setup.x", 30.4)).toEqual({ from: -470, to: 530 });
  expect(rangeAround("setup.c", 270)).toEqual({ from: -180, to: 270 });
  expect(rangeAround("tool_length", 120)).toEqual({ from: 0, to: 620 });
});

test("a window does not depend on the value of its own parameter", () => {
  const ask = (settings: typeof DEFAULTS) => toolpathRequest("id", "verne", settings, OVER_TABLE);
  const moved = { ...DEFAULTS, setup: { ...ORIGIN, y: 7 } };
  expect(without("setup.y", ask(moved))).toEqual(without("setup.y", ask(DEFAULTS)));
  expect(without("setup.x", ask(moved))).not.toEqual(without("setup.x", ask(DEFAULTS)));
  const longer = { ...DEFAULTS, lengths: 80 };
  expect(JSON.stringify(without("tool_length", ask(longer)))).toBe(
    JSON.stringify(without("tool_length", ask(DEFAULTS))),
  );
});

test("tools with lengths of their own have no window in common", () => {
  const tools = [
    { line: 1, number: 1 },
    { line: 2, number: 2 },
  ];
  expect(hasOneLength(tools, DEFAULTS)).toBe(false);
  expect(hasOneLength(tools, { ...DEFAULTS, lengths: 100 })).toBe(true);
  expect(hasOneLength(tools.slice(1), DEFAULTS)).toBe(true);
});
