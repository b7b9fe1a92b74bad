/** Where a pointer points: on the canvas, and along its ray in the scene. */

import { Raycaster, Vector2 } from "three";
import type { Stage } from "./stage";

/** The pointer's place on the canvas, -1 to 1 both ways. */
export function onCanvas(canvas: HTMLCanvasElement, event: PointerEvent): Vector2 {
  const { left, top, width, height } = canvas.getBoundingClientRect();
  return new Vector2(((event.clientX - left) / width) * 2 - 1, 1 - ((event.clientY - top) / height) * 2);
}

/** The ray under the pointer. */
export function rayOf(stage: Stage, event: PointerEvent): Raycaster {
  const ray = new Raycaster();
  ray.setFromCamera(onCanvas(stage.canvas, event), stage.camera);
  return ray;
}
