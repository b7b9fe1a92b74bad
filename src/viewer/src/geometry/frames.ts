/** The machine's frames as matrices; lengths in mm, angles in degrees as on the wire. */

import { MathUtils, Matrix4 } from "three";
import type { Machine, PlatformPose } from "verne-client";

export interface TableAngles {
  theta1: number;
  theta2: number;
}

export const AT_REST: TableAngles = { theta1: 0, theta2: 0 };

const METRES = 1e-3;

/** From the base frame (mm, z down) to the scene (metres, Y up): (x, y, z) becomes (x, -z, y). */
export const SCENE_FROM_BASE = new Matrix4()
  .makeScale(METRES, METRES, METRES)
  .multiply(new Matrix4().makeRotationX(Math.PI / 2));

/** From the table frame (mm, z up) to a GLB of the table frame: (x, y, z) becomes (x, z, -y). */
const GLB_FROM_PART = new Matrix4()
  .makeScale(METRES, METRES, METRES)
  .multiply(new Matrix4().makeRotationX(-Math.PI / 2));

/** The platform frame in the base frame, Eq (1). */
export function baseFromPlatform({ x, y, z, alpha }: PlatformPose): Matrix4 {
  return new Matrix4().makeRotationX(MathUtils.degToRad(alpha)).setPosition(x, y, z);
}

/** What tilts: the cradle, with its origin on the tilting axis. */
export function baseFromCradle(table: Machine["table"], theta1: number): Matrix4 {
  return new Matrix4().makeRotationX(MathUtils.degToRad(theta1)).setPosition(0, 0, table.da);
}

/** The table frame in the base frame, Eq (7). */
export function baseFromTable(table: Machine["table"], { theta1, theta2 }: TableAngles): Matrix4 {
  return baseFromCradle(table, theta1)
    .multiply(new Matrix4().makeTranslation(0, 0, table.dt))
    .multiply(new Matrix4().makeRotationX(Math.PI))
    .multiply(new Matrix4().makeRotationZ(MathUtils.degToRad(theta2)));
}

/** Where a GLB of the table frame stands in the scene. */
export function sceneFromPartGlb(table: Machine["table"], angles: TableAngles): Matrix4 {
  return SCENE_FROM_BASE.clone()
    .multiply(baseFromTable(table, angles))
    .multiply(GLB_FROM_PART.clone().invert());
}

/** From the base frame or the table frame, mm, to the scene; without a table the base frame. */
export function sceneFromFrame(
  frame: "base" | "part",
  table: Machine["table"] | undefined,
  angles: TableAngles = AT_REST,
): Matrix4 {
  const scene = SCENE_FROM_BASE.clone();
  return frame === "base" || !table ? scene : scene.multiply(baseFromTable(table, angles));
}
