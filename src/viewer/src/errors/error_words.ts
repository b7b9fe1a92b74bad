/** Errors of the tool in words. */

import type { ErrorMapSummary, MeshError } from "verne-client";
import { degrees, mm } from "../words/numbers";
import type { GlbSurface } from "../geometry/glb";

export const ERRORS: readonly (readonly [MeshError, string])[] = [
  ["tip_worst", "position, worst"],
  ["tip_rms", "position, rms"],
  ["axis_worst", "angle, worst"],
  ["axis_rms", "angle, rms"],
];

/** What the parameters' deviations may be so that an error is what it is. */
export const MEANINGS: Readonly<Record<MeshError, string>> = {
  tip_worst: "Greatest displacement of the tool end, if each parameter deviates by at most its tolerance.",
  tip_rms: "Root mean square displacement of the tool end, if the tolerances are standard deviations.",
  axis_worst: "Greatest angle of the tool’s axis, if each parameter deviates by at most its tolerance.",
  axis_rms: "Root mean square angle of the tool’s axis, if the tolerances are standard deviations.",
};

export function errorInWords(error: MeshError, value: number): string {
  return error.startsWith("axis") ? degrees(value, 5) : mm(value, 4);
}

/** From the least error to the largest that was found. */
export function rangeInWords(error: MeshError, { errors }: ErrorMapSummary): string {
  const range = errors?.[error];
  if (!range) return "none";
  return `${errorInWords(error, range.least)} to ${errorInWords(error, range.largest)}`;
}

interface Band {
  name: string;
  colour: string;
}

/** The bands of a mesh, the largest errors first, with the ends that their names state. */
export function bandsOf({ palette }: Pick<GlbSurface, "palette">): Band[] {
  return palette
    .map(({ name, rgb }) => {
      const [, from = "", to = "", unit = ""] = /([\d.]+) to ([\d.]+) (\w+)$/.exec(name) ?? [];
      const [space, sign] = unit === "deg" ? ["", "°"] : ["\u00a0", unit];
      return { name: `${from} to ${to}${space}${sign}`, colour: `rgb(${rgb.join(" ")})` };
    })
    .reverse();
}
