/** The parameters whose windows are asked for, and the ranges in which they are looked for. */

import type { Schemas, ToolpathRequest } from "verne-client";
import type { Settings } from "./settings";

export const WINDOW_NAMES = ["setup.x", "setup.y", "setup.z", "setup.c", "tool_length"] as const;
export type WindowName = (typeof WINDOW_NAMES)[number];

/** How far from the present value a window is looked for, mm. */
const WAY = 500;
/** The length of a tool of which none is known, mm. */
const USUAL = 100;

/** The value that the settings have now; `stated` is the length that the program states. */
export function valueOf(name: WindowName, { setup, lengths }: Settings, stated: number | null): number {
  if (name !== "tool_length") return setup[axisOf(name)];
  return typeof lengths === "number" ? lengths : (stated ?? USUAL);
}

/** The settings with another value of a parameter. */
export function withValue(name: WindowName, settings: Settings, value: number): Settings {
  if (name === "tool_length") return { ...settings, lengths: value };
  return { ...settings, setup: { ...settings.setup, [axisOf(name)]: value } };
}

/** The range in which a window is looked for: around the value, or all there is. */
export function rangeAround(name: WindowName, value: number): { from: number; to: number } {
  if (name === "setup.c") return { from: Math.min(-180, value), to: Math.max(180, value) };
  const middle = Math.round(value);
  const from = middle - WAY;
  return { from: name === "tool_length" ? Math.max(from, 0) : from, to: middle + WAY };
}

/** A request without the parameter: equal ones have the same window. */
export function without(name: WindowName, request: ToolpathRequest): ToolpathRequest {
  if (name !== "tool_length") return { ...request, setup: { ...request.setup, [axisOf(name)]: 0 } };
  const rest = Object.entries(request).filter(([key]) => key !== "tool_length" && key !== "length_before");
  return { ...(Object.fromEntries(rest) as ToolpathRequest), tool_length: 0 };
}

/** Whether one length can stand for those of all tools: there is one tool, or one length for all. */
export function hasOneLength(tools: Schemas["ProgramTool"][], { lengths }: Settings): boolean {
  return typeof lengths === "number" || tools.length <= 1;
}

function axisOf(name: Exclude<WindowName, "tool_length">): "x" | "y" | "z" | "c" {
  return name.slice(-1) as "x" | "y" | "z" | "c";
}
