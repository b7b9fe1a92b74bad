/** A placement in words. */

import type { Schemas } from "verne-client";
import { kept } from "../words/margins";
import { number, withUnit } from "../words/numbers";
import { count, wouldBreak } from "./failure_words";

/** How much of the reserve is kept: `t` of a placement. */
export function reserveWords(t: number | null | undefined): string {
  if (t == null) return "out of reach";
  if (t < 0) return `misses a limit by ${number(-t, 2)} of its reserve`;
  return t < 1 ? `${number(100 * t, 0)} % of the reserve` : `${number(t, 2)} times the reserve`;
}

/** A margin that limits the placement, with its line. */
export function activeWords({
  line,
  constraint,
  element,
  margin,
  unit,
  reserve,
}: Schemas["ActiveMargin"]): string {
  const limit = { constraint, element, unit, value: margin };
  const sentence = margin < 0 ? wouldBreak(limit) : kept(limit);
  const wanted = reserve === undefined ? "" : ` (reserve ${withUnit(reserve, unit)})`;
  return `line ${count(line)}: ${sentence}${wanted}`;
}

/** What is guaranteed, and what is not. */
export function guaranteeWords(
  { starts }: Schemas["PlacementGuarantee"],
  rows: number,
  withinBounds: boolean,
): string {
  const searches = starts === 1 ? "one search" : `${count(starts)} searches`;
  const worse = withinBounds ? " It is never worse than the set-up before." : "";
  return (
    `All ${count(rows)} joint rows of this set-up, and the ways between them, were checked. It is the best of ` +
    `${searches}; it is not proved that no other set-up is better.${worse}`
  );
}
