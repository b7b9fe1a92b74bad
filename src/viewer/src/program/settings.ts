/** The set-up of a program on the table, and how the service plans its motion. */

import type { MachineRef, Schemas, ToolpathRequest } from "verne-client";

/** The lengths that the program states, one for every tool, or one for each tool number. */
export type ToolLengths = "program" | number | Record<string, number>;

/** Origin, mm, and rotations about x, then y, then z, degrees. */
export type SetUp = Required<Schemas["Setup"]>;

export interface Settings {
  setup: SetUp;
  /** The frames of other work offsets than G54, by their names. */
  offsets: Record<string, SetUp>;
  lengths: ToolLengths;
  /** The tool of the moves before the first tool, where each tool has its length; null: such moves are faults. */
  toolBefore: number | null;
  /** Greatest deviations: tip and rapids in mm, axis in degrees. */
  tolerance: Required<Schemas["Tolerance"]>;
  /** Null: as the words of each point say. */
  orientation: Schemas["OrientationInterpolation"] | null;
  tip: Schemas["Tip"];
  rapids: Schemas["Rapids"];
  onLimit: Schemas["OnLimit"];
  holdRotary: boolean;
}

export const ORIGIN: SetUp = { x: 0, y: 0, z: 0, a: 0, b: 0, c: 0 };

/** The defaults of the service. */
export const DEFAULTS: Settings = {
  setup: ORIGIN,
  offsets: {},
  lengths: "program",
  toolBefore: null,
  tolerance: { tip: 0.01, axis: 0.05, rapid: 1 },
  orientation: null,
  tip: "end",
  rapids: "linear",
  onLimit: "fail",
  holdRotary: false,
};

/** The limits of the table as requests have them. */
export interface OverTable {
  table_clearance: number;
  tool_radius: number;
}

/** The request for the tool path of a stored program. */
export function toolpathRequest(
  program: string,
  machine: MachineRef,
  settings: Settings,
  overTable: OverTable,
): ToolpathRequest {
  const { setup, offsets, lengths, toolBefore, tolerance, orientation, tip, rapids, onLimit, holdRotary } =
    settings;
  return {
    program,
    machine,
    setup,
    ...(Object.keys(offsets).length > 0 && { offsets }),
    ...(lengths !== "program" && { tool_length: lengths }),
    ...(typeof lengths === "object" && toolBefore !== null && { length_before: toolBefore }),
    tolerance,
    ...(orientation && { orientation }),
    tip,
    rapids,
    on_limit: onLimit,
    ...(holdRotary && { hold_rotary: true }),
    ...overTable,
  };
}

/** What can be changed by the change that heals a failure. */
type Change = Schemas["ToolpathChange"];

/** The settings with a change of the set-up or of a tool's length. `length` is that of the tool that failed. */
export function changed(settings: Settings, { parameter, delta }: Change, length: number): Settings {
  switch (parameter) {
    case "setup.x":
    case "setup.y":
    case "setup.z": {
      const axis = parameter.slice(-1) as "x" | "y" | "z";
      return { ...settings, setup: { ...settings.setup, [axis]: settings.setup[axis] + delta } };
    }
    case "tool_length": {
      const { lengths } = settings;
      if (typeof lengths !== "object") return { ...settings, lengths: length + delta };
      const longer = (value: number) => (Math.abs(value - length) < 1e-9 ? value + delta : value);
      const entries = Object.entries(lengths).map(([tool, value]) => [tool, longer(value)] as const);
      return { ...settings, lengths: Object.fromEntries(entries) };
    }
  }
}

/** Whether the numbers of the tools with lengths of their own are to be asked for. */
export function toolNumbers(tools: Schemas["ProgramTool"][]): number[] {
  const numbers = tools.flatMap(({ number }) => (number == null ? [] : [number]));
  return [...new Set(numbers)].sort((a, b) => a - b);
}

/** The settings that a program begins with: its own lengths where it states them all, otherwise this one. */
export function initialSettings(tools: Schemas["ProgramTool"][], length: number): Settings {
  const stated = tools.length > 0 && tools.every((tool) => tool.length != null);
  return { ...DEFAULTS, lengths: stated ? "program" : length };
}
