/** An atlas in words. */

import type { Atlas, AtlasSpace } from "verne-client";
import { number } from "../words/numbers";
import type { Share } from "./atlas_plane";

export const PLANES: Readonly<Record<AtlasSpace, { name: string; u: string; v: string; counted: string }>> = {
  platform: {
    name: "platform",
    u: "x",
    v: "y",
    counted: "How many positions of the sliders lead to each place of the platform",
  },
  joints: {
    name: "sliders",
    u: "ρ₂ − ρ₁",
    v: "ρ₃ − ρ₁",
    counted: "How many postures each position of the sliders allows",
  },
};

/** What happens on a curve. */
export const CURVES: Readonly<Record<Atlas["curves"][number]["kind"], string>> = {
  leg_1: "two angles of leg 1 merge",
  leg_2: "leg 2 is level",
  leg_3: "leg 3 is level",
  parallel: "two postures merge: det P is zero",
  constraint: "leg 1 is level: the platform can begin to turn",
};

/** What a special point is: one of them, and several. */
export const POINTS: Readonly<Record<Atlas["points"][number]["kind"], readonly [string, string]>> = {
  cusp: ["cusp", "cusps"],
  crossing: ["crossing", "crossings"],
  corner: ["corner", "corners"],
  tangency: ["tangency", "tangencies"],
  isolated: ["isolated point", "isolated points"],
  self_motion: ["point of self-motion", "points of self-motion"],
};

export function solutionsInWords(solutions: number): string {
  if (solutions === 0) return "no solution";
  return solutions === 1 ? "1 solution" : `${solutions} solutions`;
}

/** An area with its error; the printed area has been rounded to a square centimetre, which the bound includes. */
export function areaInWords({ area, error }: Pick<Share, "area" | "error">): string {
  const bound = Math.ceil((error + 50) / 100);
  return `${number(area / 1e6, 4)} m² ± ${number(bound, 0)} cm²`;
}

/** How many special points of each kind there are. */
export function pointsInWords(points: Atlas["points"]): string {
  const counts = new Map<keyof typeof POINTS, number>();
  for (const { kind } of points) counts.set(kind, (counts.get(kind) ?? 0) + 1);
  return [...counts].map(([kind, count]) => `${count} ${POINTS[kind][count === 1 ? 0 : 1]}`).join(", ");
}

export const WORKING = "a solution in the working mode";

/** The colour of a number of solutions among all numbers of the map: the more solutions, the farther from the ground. */
export function colourOf(solutions: number, counts: readonly number[]): string {
  const place = Math.max(counts.indexOf(solutions), 0) / Math.max(counts.length - 1, 1);
  return `color-mix(in oklab, var(--atlas-most) ${Math.round(place * 100)}%, var(--atlas-least))`;
}
