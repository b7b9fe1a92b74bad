/** The tool's angles on the part from a direction in the part frame; degrees. */

import { MathUtils, Vector3 } from "three";

/** Unit vector of the azimuth phi2: the horizontal direction to which a tool with positive phi1 leans. */
export function azimuth(phi2: number): Vector3 {
  const angle = MathUtils.degToRad(phi2);
  return new Vector3(Math.sin(angle), -Math.cos(angle), 0);
}

/** Unit vector from the tool end to the holder. */
export function toolAxis(phi1: number, phi2: number): Vector3 {
  const angle = MathUtils.degToRad(phi1);
  return azimuth(phi2).multiplyScalar(Math.sin(angle)).setZ(Math.cos(angle));
}

/** phi2 of a horizontal direction, the value nearest to `before`. */
export function phi2Towards(direction: Vector3, before: number): number {
  return nearest(MathUtils.radToDeg(Math.atan2(direction.x, -direction.y)), before);
}

/** phi1 of a direction in the vertical plane of phi2, the value nearest to `before`. */
export function phi1Towards(direction: Vector3, phi2: number, before: number): number {
  return nearest(MathUtils.radToDeg(Math.atan2(direction.dot(azimuth(phi2)), direction.z)), before);
}

function nearest(angle: number, before: number): number {
  return angle + 360 * Math.round((before - angle) / 360);
}
