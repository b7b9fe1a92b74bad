/** A disc, so that points are round. */

import { CanvasTexture } from "three";

const SIZE = 32;

export function roundPoint(): CanvasTexture {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = SIZE;
  const context = canvas.getContext("2d");
  if (context) {
    context.fillStyle = "white";
    context.beginPath();
    context.arc(SIZE / 2, SIZE / 2, SIZE / 2 - 1, 0, 2 * Math.PI);
    context.fill();
  }
  return new CanvasTexture(canvas);
}
