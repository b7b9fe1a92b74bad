/** The distance between two points of the scene that the operator clicks. */

import { computed, signal } from "@preact/signals";

/** In the base frame, mm. */
export type Point = readonly [number, number, number];

/** Null: nothing is measured; otherwise the points that are chosen so far. */
export const measured = signal<readonly Point[] | null>(null);
export const measuring = computed(() => measured.value !== null);

export interface Measurement {
  distance: number;
  /** Along x, y and z of the base frame, from the first point to the second. */
  along: Point;
}

export const measurement = computed<Measurement | null>(() => {
  const [from, to] = measured.value ?? [];
  return from && to ? between(from, to) : null;
});

export function between(from: Point, to: Point): Measurement {
  const along: Point = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
  return { distance: Math.hypot(...along), along };
}

/** Takes a point: the second one ends a measurement, another one begins the next. */
export function take(point: Point): void {
  const before = measured.peek() ?? [];
  measured.value = before.length === 1 ? [...before, point] : [point];
}

export function toggleMeasuring(): void {
  measured.value = measuring.peek() ? null : [];
}
