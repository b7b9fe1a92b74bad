/** Failures, changes and warnings of a tool path in words. */

import type { Limit, Schemas } from "verne-client";
import { end, leg, lowest, rods } from "../words/elements";
import { degrees, mm, number } from "../words/numbers";

type Failure = Schemas["ToolpathFailure"];
type Change = Schemas["ToolpathChange"];

/** A failure as a sentence with its lines. */
export function failureSentence({ lines, constraint, element, margin, unit }: Failure): string {
  const [first = 0, last = first] = lines;
  const where = first === last ? `line ${count(first)}` : `lines ${count(first)} to ${count(last)}`;
  return `${where}: ${wouldBreak({ constraint, element, value: margin, unit })}`;
}

/** What a machine that followed the program would break; the value is negative. */
export function wouldBreak({ constraint, element, value }: Limit): string {
  const over = Math.abs(value);
  switch (constraint) {
    case "stroke": {
      const [slider = "", which] = element.split(".");
      return `${slider.replace(/^slider/, "slider ")} would be ${mm(over)} beyond its ${end(which)} end`;
    }
    case "leg_length":
      return `${leg(element)} would be too short by ${mm(over)}`;
    case "slider_joint":
      return `${rods(element)} would bend ${degrees(over)} too far at the slider`;
    case "platform_joint":
      return `${rods(element)} would bend ${degrees(over)} too far at the platform`;
    case "rod_crossing":
      return "the rods of leg 1 would cross";
    case "rod_interference":
      return `${rods(element)} would run into each other by ${mm(over)}`;
    case "serial_singularity":
      return `${rods(element)} would be too nearly across the guideway (by ${number(over, 3)})`;
    case "parallel_singularity":
      return `the platform would not be held firmly enough (by ${number(over, 3)})`;
    case "tilt":
      return `the table would tilt ${degrees(over)} too far`;
    case "rotary":
      return `the table would turn ${degrees(over)} too far`;
    case "table_clearance":
      return `${lowest(element)} would be ${mm(over)} too low over the table`;
  }
}

/** The change that heals a failure, as the text of a button. */
export function changeWords({ parameter, delta }: Change): string {
  const sign = delta < 0 ? "" : "+";
  if (parameter === "tool_length")
    return `make the tool ${mm(Math.abs(delta))} ${delta < 0 ? "shorter" : "longer"}`;
  return `move the set-up by ${sign}${mm(delta)} in ${parameter.slice(-1).toUpperCase()}`;
}

/** A time as hours, minutes and seconds. */
export function clock(seconds: number): string {
  const whole = Math.floor(seconds);
  const [hours, minutes, rest] = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60, whole % 60];
  const two = (value: number) => String(value).padStart(2, "0");
  const tenths = Math.floor((seconds - whole) * 10);
  if (hours > 0) return `${hours}:${two(minutes)}:${two(rest)}`;
  return `${minutes}:${two(rest)}.${tenths}`;
}

/** A whole number with its thousands apart. */
export function count(value: number): string {
  return number(value, 0);
}
