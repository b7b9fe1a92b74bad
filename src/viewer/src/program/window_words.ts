/** The windows of a parameter in words. */

import type { Schemas, Window } from "verne-client";
import { boundary } from "../words/elements";
import { number, withUnit } from "../words/numbers";
import { count, wouldBreak } from "./failure_words";

type End = Schemas["WindowEnd"];

/** An interval with its unit. */
export function intervalWords({ from, to }: { from: number; to: number }, unit: Window["unit"]): string {
  return `runs from ${number(from, 1)} to ${withUnit(to, unit)}`;
}

/** What ends an interval below or above. */
export function endWords(end: End, side: "below" | "above"): string {
  if (end.kind === "bound") return `${side}: not examined`;
  return `${side}: line ${count(end.line)}, ${boundary(end.constraint, end.element)}`;
}

/** Why there is no window. */
export function noWindowWords(
  { from, to }: { from: number; to: number },
  unit: Window["unit"],
  nearest: Window["nearest"],
): string {
  const none = `No value from ${number(from, 1)} to ${withUnit(to, unit)} was found with which the program runs.`;
  const { value, margin } = nearest ?? {};
  if (value === undefined) return none;
  const at = `${none} ${withUnit(value, unit)} comes nearest`;
  if (!margin) return `${at}.`;
  const { constraint, element, margin: by, unit: of, line } = margin;
  return `${at}; there, in line ${count(line)}, ${wouldBreak({ constraint, element, value: by, unit: of })}.`;
}

/** What was checked of a window, and what was not. */
export function windowGuarantee({ resolution, unit }: Pick<Window, "resolution" | "unit">): string {
  const narrow = unit === "deg" ? `${number(resolution, 2)}°` : `${number(resolution, 2)}\u00a0mm`;
  return `The whole program was checked at both ends of each window; windows and gaps narrower than ${narrow} may be missed.`;
}
