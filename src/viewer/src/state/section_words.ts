/** The settings of the sections that are opened, in words of the address. */

import {
  CELLS,
  FAMILY_COUNTS,
  INITIAL,
  type DexterityView,
  type ErrorsView,
  type FamilyParameter,
  type FamilyView,
} from "./view";

const WORDS: Readonly<Record<FamilyParameter, string>> = { tool_length: "tool", phi1: "phi1" };
const PARAMETERS = ["tool_length", "phi1"] as const;

/** Parameter, first and last value, number of values. */
export function familyWords({ parameter, ranges }: FamilyView): string {
  const { from, to, count } = ranges[parameter];
  return [WORDS[parameter], from, to, count].join();
}

/** Null for words that are no such settings. */
export function asFamily(words: string | null): FamilyView | null {
  const [word, ...rest] = words?.split(",") ?? [];
  const parameter = PARAMETERS.find((known) => WORDS[known] === word);
  const [from = NaN, to = NaN, count = NaN] = rest.map((value) =>
    value.trim() === "" ? NaN : Number(value),
  );
  const { least, greatest } = FAMILY_COUNTS;
  const counted = Number.isInteger(count) && count >= least && count <= greatest;
  // A tool has no negative length.
  const low = parameter === "tool_length" ? 0 : -Infinity;
  const between = [from, to].every((value) => Number.isFinite(value) && value >= low);
  if (!parameter || rest.length !== 3 || !counted || !between) return null;
  const { ranges } = INITIAL.family;
  return { open: true, parameter, ranges: { ...ranges, [parameter]: { from, to, count } } };
}

/** First and last inclination, distance between points. */
export function dexterityNumbers({ from, to, cell }: DexterityView): string {
  return [from, to, cell].join();
}

/** Null for numbers that are no such settings. */
export function asDexterity(numbers: number[] | null): DexterityView | null {
  const [from = 0, to = 0, cell = 0] = numbers ?? [];
  const possible = cell >= CELLS.least && cell <= CELLS.greatest;
  return numbers && possible ? { open: true, from, to, cell } : null;
}

/** The tolerances of rods, sliders, joints, axes and angles. */
export function errorsNumbers({ tolerances: { rods, sliders, joints, axes, angles } }: ErrorsView): string {
  return [rods, sliders, joints, axes, angles].join();
}

/** Null for numbers that are no tolerances. */
export function asErrors(numbers: number[] | null): ErrorsView | null {
  if (!numbers || numbers.some((value) => value < 0)) return null;
  const [rods = 0, sliders = 0, joints = 0, axes = 0, angles = 0] = numbers;
  return { open: true, tolerances: { rods, sliders, joints, axes, angles } };
}
