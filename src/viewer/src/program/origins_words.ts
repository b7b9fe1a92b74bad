/** The region of origins in words. */

import type { OriginsSummary } from "verne-client";
import { number } from "../words/numbers";

type Region = Pick<OriginsSummary, "volume" | "volume_error" | "bounds">;

/** How large the region is, and where. */
export function regionWords({ volume, volume_error: error, bounds }: Region): string {
  if (!bounds) return "No origin was found with which the machine can follow the program.";
  const along = (axis: string, i: number) =>
    `${axis} ${number(bounds.min[i] ?? 0, 0)} to ${number(bounds.max[i] ?? 0, 0)}`;
  const within = ["x", "y", "z"].map(along).join(", ");
  return `The origin may be in the region that the scene shows: ${litres(volume)} (± ${litres(error)}), within ${within}\u00a0mm.`;
}

/** A volume given in mm³, as litres. */
function litres(volume: number): string {
  const found = volume / 1e6;
  return `${number(found, found < 10 ? 2 : 0)}\u00a0litres`;
}

/** What is not checked, and what decides. */
export function regionHint(cell: number): string {
  return (
    `Pieces smaller than a cell of ${number(cell, 0)}\u00a0mm may be missing, and rapids in which the table turns are not ` +
    "examined: the verdict on the program decides about one origin."
  );
}
