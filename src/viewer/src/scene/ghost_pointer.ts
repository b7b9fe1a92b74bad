/** Ghosts are pointed at and picked by hand in the scene, as in their list. */

import { Vector2 } from "three";
import { pick } from "../state/motion";
import { measuring } from "../state/measurement";
import { ghosts, pointed } from "../state/store";
import type { Ghosts } from "./ghosts";
import { onCanvas } from "./pointing";

/** A press that moves farther turns the camera, px. */
const STILL = 4;

export function listenForGhosts(canvas: HTMLCanvasElement, drawn: Ghosts): void {
  let pressed = new Vector2();
  const at = (event: PointerEvent) => onCanvas(canvas, event);
  canvas.addEventListener("pointerdown", (event) => {
    pressed = new Vector2(event.clientX, event.clientY);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (event.buttons === 0 && ghosts.peek().length > 0) pointed.value = drawn.under(at(event));
  });
  canvas.addEventListener("pointerup", (event) => {
    if (measuring.peek()) return;
    if (pressed.distanceTo(new Vector2(event.clientX, event.clientY)) > STILL) return;
    const ghost = ghosts.peek()[drawn.under(at(event)) ?? -1];
    if (ghost) pick(ghost);
  });
}
