/** The ends of the six rods, as the closure equations (3)-(6) place them. */

import { MathUtils, Vector3 } from "three";
import type { Machine, PlatformPose } from "verne-client";
import { baseFromPlatform } from "./frames";

export type RodName = "11" | "12" | "21" | "22" | "31" | "32";
export type Sliders = readonly [number, number, number];

export interface Rod {
  name: RodName;
  /** Which slider carries it: 0, 1 or 2. */
  leg: 0 | 1 | 2;
  /** Joint at the slider, base frame, mm. */
  slider: Vector3;
  /** Joint at the platform, base frame, mm. */
  platform: Vector3;
}

/** The joints on the sliders with rho = 0 and on the platform in its own frame, rod by rod. */
export function joints(g: Machine["geometry"]): Rod[] {
  const direction = MathUtils.degToRad(g.parallelogram_direction ?? 0);
  const w = g.parallelogram_half_width * Math.cos(direction);
  const v = g.parallelogram_half_width * Math.sin(direction);
  const rod = (name: RodName, leg: 0 | 1 | 2, a: [number, number], b: [number, number]): Rod => ({
    name,
    leg,
    slider: new Vector3(a[0], a[1], 0),
    platform: new Vector3(b[0], b[1], 0),
  });
  return [
    rod("11", 0, [g.d1, g.r1], [g.D1, g.R1]),
    rod("12", 0, [g.d1, -g.r1], [g.D1, -g.R1]),
    rod("21", 1, [g.d2 + w, v - g.r4], [g.D2 + w, v - g.R2]),
    rod("22", 1, [g.d2 - w, -v - g.r4], [g.D2 - w, -v - g.R2]),
    rod("31", 2, [g.d2 + w, g.r4 - v], [g.D2 + w, g.R2 - v]),
    rod("32", 2, [g.d2 - w, g.r4 + v], [g.D2 - w, g.R2 + v]),
  ];
}

/** The rods of a machine that stands at these sliders with its platform there. */
export function rods(geometry: Machine["geometry"], rho: Sliders, pose: PlatformPose): Rod[] {
  const place = baseFromPlatform(pose);
  return joints(geometry).map((rod) => ({
    ...rod,
    slider: rod.slider.setZ(rho[rod.leg]),
    platform: rod.platform.applyMatrix4(place),
  }));
}
