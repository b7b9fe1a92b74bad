/** The scene as a picture, with its labels. */

import type { Stage } from "./stage";

/** Pixels of the picture for each that is shown, each way. */
const FINE = 2;

export async function picture(stage: Stage, labels: HTMLElement): Promise<Blob> {
  const { canvas, renderer } = stage;
  const { clientWidth: width, clientHeight: height } = canvas;
  const ratio = renderer.getPixelRatio();
  const drawn = document.createElement("canvas");
  drawn.width = width * FINE;
  drawn.height = height * FINE;
  const context = drawn.getContext("2d");
  if (!context) throw new Error("This browser draws no pictures.");
  renderer.setPixelRatio(FINE);
  stage.render();
  // The canvas keeps its picture only until this task ends.
  context.drawImage(canvas, 0, 0, drawn.width, drawn.height);
  renderer.setPixelRatio(ratio);
  stage.draw();
  context.scale(FINE, FINE);
  write(context, labels);
  return new Promise((resolve, reject) => {
    drawn.toBlob((blob) => {
      if (blob) resolve(blob);
      else reject(new Error("This browser cannot write the picture."));
    }, "image/png");
  });
}

/** The labels as they are placed now. */
function write(context: CanvasRenderingContext2D, labels: HTMLElement): void {
  const origin = labels.getBoundingClientRect();
  context.textBaseline = "middle";
  context.textAlign = "center";
  for (const label of labels.querySelectorAll<HTMLElement>(".label")) {
    const { display, visibility, backgroundColor, color, font } = getComputedStyle(label);
    if (display === "none" || visibility === "hidden") continue;
    const { left, top, width, height } = label.getBoundingClientRect();
    context.fillStyle = backgroundColor;
    context.fillRect(left - origin.left, top - origin.top, width, height);
    context.fillStyle = color;
    context.font = font;
    context.fillText(label.textContent, left - origin.left + width / 2, top - origin.top + height / 2);
  }
}
