import { expect, test } from "vitest";
import { freeOf, reserveOf, usualFreedoms } from "./placement_bounds";
import { DEFAULTS, ORIGIN } from "./settings";

test("the bounds that are offered lie around the present set-up, and no tool is shorter than nothing", () => {
  const all = usualFreedoms({ ...DEFAULTS, setup: { ...ORIGIN, x: 40 }, lengths: 30 });
  expect(all["setup.x"]).toEqual({ free: true, from: -160, to: 240 });
  expect(all["setup.c"].free).toBe(false);
  expect(all.tool_length).toEqual({ free: false, from: 0, to: 80 });
});

test("the tool's length is free only where one length holds for every tool", () => {
  const all = usualFreedoms({ ...DEFAULTS, lengths: 100 });
  const chosen = { ...all, tool_length: { ...all.tool_length, free: true } };
  expect(freeOf(chosen, true)).toHaveProperty("tool_length", [50, 150]);
  expect(freeOf(chosen, false)).not.toHaveProperty("tool_length");
  expect(freeOf(chosen, false)).toHaveProperty(["setup.x"], [-200, 200]);
});

test("a reserve of nothing is not asked for", () => {
  expect(reserveOf({ stroke: 20, slider_joint: 0 })).toEqual({ stroke: 20 });
});
