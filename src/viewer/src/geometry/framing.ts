/** A camera from which all of some points are seen. */

import { Box3, Vector3 } from "three";
import type { Camera } from "../state/view";

/** Room around the points, as a part of the picture. */
const ROOM = 0.07;
const UP = new Vector3(0, 1, 0);

/**
 * `from` points to the camera; `half` is half of a perspective camera's vertical angle, radians, or null for a parallel
 * one; `aspect` is the picture's width by its height.
 */
export function framing(points: Vector3[], from: Vector3, half: number | null, aspect: number): Camera {
  const box = new Box3().setFromPoints(points);
  const centre = box.getCenter(new Vector3());
  const back = from.clone().normalize();
  const right = UP.clone().cross(back).normalize();
  const up = back.clone().cross(right);
  const size = 1 + 2 * ROOM;
  let distance = 0;
  let tallest = 0;
  for (const point of points) {
    const offset = point.clone().sub(centre);
    const extent = Math.max(Math.abs(offset.dot(up)), Math.abs(offset.dot(right)) / aspect) * size;
    tallest = Math.max(tallest, extent);
    if (half !== null) distance = Math.max(distance, offset.dot(back) + extent / Math.tan(half));
  }
  if (half === null) distance = 2 * box.getSize(new Vector3()).length();
  const eye = centre.clone().addScaledVector(back, distance);
  return { eye: eye.toArray(), target: centre.toArray(), height: half === null ? 2 * tallest : null };
}
