/** The members of a family as points of the plot and rows of the table. */

import type { FamilySummary } from "verne-client";
import { degrees, mm, number } from "../words/numbers";
import type { FamilyParameter } from "../state/view";

export interface Member {
  /** The value of the parameter, mm or degrees. */
  value: number;
  /** mm³; null where `reason` says why there is none. */
  volume: number | null;
  /** The true volume lies within `volume` ± this, mm³. */
  error: number;
  reason: string | null;
}

export function membersOf({ members }: FamilySummary, parameter: FamilyParameter): Member[] {
  return members.map((member) => {
    const { [parameter]: value } = member.request;
    const volume = ("volume" in member && member.volume) ?? null;
    const error = ("volume_error" in member && member.volume_error) || 0;
    const folded = "folded" in member && member.folded;
    return {
      value: typeof value === "number" ? value : 0,
      volume: volume === false ? null : volume,
      error,
      reason: typeof volume === "number" ? null : reasonOf(member.failure, folded),
    };
  });
}

function reasonOf(failure: string | undefined, folded: boolean): string {
  if (failure !== undefined) return failure;
  return folded ? "no volume: two platform positions reach the same position" : "no volume";
}

/** The columns of the plot: values, and volumes in m³. */
export function columnsOf(members: readonly Member[]): [number[], (number | null)[]] {
  return [
    members.map(({ value }) => value),
    members.map(({ volume }) => (volume === null ? null : volume / 1e9)),
  ];
}

export function valueInWords(parameter: FamilyParameter, value: number): string {
  return parameter === "phi1" ? degrees(value) : mm(value);
}

export const NAMES: Readonly<Record<FamilyParameter, string>> = { tool_length: "tool length", phi1: "φ₁" };

/** A volume with its error; the last digit of the error is rounded up, so that the bound still holds. */
export function volumeInWords({ volume, error, reason }: Member): string {
  if (volume === null) return reason ?? "no volume";
  return `${number(volume / 1e9, 6)} m³ ± ${errorInWords(error)}`;
}

/** An error bound in cm³. The printed volume has been rounded to a cm³, which the bound includes. */
function errorInWords(error: number): string {
  return `${number(Math.ceil((error + 500) / 100) / 10, 1)} cm³`;
}
