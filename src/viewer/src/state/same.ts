/** Whether two positions are the same, to a thousandth of a millimetre and of a radian. */

import type { Position } from "./store";

const NEAR = 1e-3;
const RADIANS = Math.PI / 180;

export function samePosition(a: Position, b: Position): boolean {
  const others = numbers(b);
  return numbers(a).every((value, i) => Math.abs(value - (others[i] ?? Infinity)) < NEAR);
}

/** The angle as a point on a circle: a full turn makes no difference. */
function numbers({ joints, solution: { platform } }: Position): number[] {
  const alpha = platform.alpha * RADIANS;
  return [...joints.rho, platform.x, platform.y, platform.z, Math.cos(alpha), Math.sin(alpha)];
}
