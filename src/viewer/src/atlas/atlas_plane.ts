/** Points of an atlas's plane: where the machine stands, where it shall go, and in which region a point lies. */

import type { Atlas, AtlasSpace, Machine, PlatformPose } from "verne-client";
import type { Joints } from "../state/view";

/** [u, v], mm. */
export type Point = readonly [number, number];
type Face = Pick<Atlas["regions"][number], "outer" | "holes">;

/** Where a position stands in the plane. */
export function pointOf(space: AtlasSpace, { rho }: Joints, { x, y }: PlatformPose): Point {
  return space === "platform" ? [x, y] : [rho[1] - rho[0], rho[2] - rho[0]];
}

/**
 * Sliders at a point of the plane of joints. All of them may be shifted together: this moves the platform along z, and
 * changes no number of solutions. They are shifted as little as brings them into their strokes; where the point is too
 * far out for that, slider 1 stays.
 */
export function slidersAt([u, v]: Point, rho1: number, { stroke }: Machine["limits"]): Joints["rho"] {
  const offsets = [0, u, v];
  const ends = stroke.map(([low = -Infinity, high = Infinity], i) => {
    const offset = offsets[i] ?? 0;
    return { least: low - offset, greatest: high - offset };
  });
  const least = Math.max(...ends.map((end) => end.least));
  const greatest = Math.min(...ends.map((end) => end.greatest));
  const first = least > greatest ? rho1 : Math.min(Math.max(rho1, least), greatest);
  return [first, first + u, first + v];
}

/** Whether a point lies in a face: a ray to the right crosses its rings an odd number of times. */
export function within([u, v]: Point, { outer, holes }: Face): boolean {
  let inside = false;
  for (const ring of [outer, ...holes])
    ring.forEach(([bu = 0, bv = 0], i) => {
      const [au = 0, av = 0] = ring.at(i - 1) ?? [];
      if (av > v !== bv > v && u < au + ((v - av) / (bv - av)) * (bu - au)) inside = !inside;
    });
  return inside;
}

/** The number of solutions at a point; null outside of the window. */
export function solutionsAt(point: Point, { regions }: Pick<Atlas, "regions">): number | null {
  return regions.find((region) => within(point, region))?.solutions ?? null;
}

/** The regions with equal numbers of solutions together, fewest solutions first. */
export interface Share {
  solutions: number;
  /** mm², of a true area within `area` ± `error`. */
  area: number;
  error: number;
}

export function sharesOf({ regions }: Pick<Atlas, "regions">): Share[] {
  const shares = new Map<number, Share>();
  for (const { solutions, area, area_error: error } of regions) {
    const sum = shares.get(solutions) ?? { solutions, area: 0, error: 0 };
    shares.set(solutions, { solutions, area: sum.area + area, error: sum.error + error });
  }
  return [...shares.values()].sort((a, b) => a.solutions - b.solutions);
}
