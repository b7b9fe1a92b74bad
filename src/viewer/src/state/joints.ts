/** The five joints as a list: three sliders (mm), tilt and turn of the table (degrees). */

import type { Machine } from "verne-client";
import type { Joints } from "./view";

/** The rotary travel that controls offer where the machine states none, degrees. */
const TURN = 360;

export function toList({ rho, theta1, theta2 }: Joints): number[] {
  return [...rho, theta1, theta2];
}

export function fromList([a = 0, b = 0, c = 0, theta1 = 0, theta2 = 0]: number[]): Joints {
  return { rho: [a, b, c], theta1, theta2 };
}

/** The ends of each joint's travel. */
export function travels({ stroke, tilt, rotary }: Machine["limits"]): [number, number][] {
  const ends = [...stroke, tilt, rotary ?? [-TURN, TURN]];
  return ends.map(([low = 0, high = 0]) => [low, high]);
}

export function clamp(value: number, min: number, max: number): number {
  return Math.min(Math.max(value, min), max);
}
