/** A face of the workspace that the pointer rests on is isolated and named; a click keeps it isolated. */

import { measuring } from "../state/measurement";
import { keptLimit, pointed, pointedLimit } from "../state/store";
import { limitInWords } from "../words/elements";
import { rayOf } from "./pointing";
import type { Stage } from "./stage";
import type { WorkspaceView } from "./workspace_view";

/** How long the pointer rests before a face is named, ms. */
const REST = 150;
/** A press that moves farther turns the camera, px. */
const STILL = 4;

export class FacePointer {
  private readonly name = document.createElement("span");
  private timer = 0;
  private pressed: PointerEvent | null = null;

  constructor(
    private readonly stage: Stage,
    private readonly workspace: WorkspaceView,
  ) {
    const { canvas } = stage;
    this.name.className = "label face";
    this.name.hidden = true;
    canvas.after(this.name);
    canvas.addEventListener("pointermove", (event) => this.move(event));
    canvas.addEventListener("pointerleave", () => this.leave());
    canvas.addEventListener("pointerdown", (event) => {
      this.pressed = event;
      this.leave();
    });
    canvas.addEventListener("pointerup", (event) => this.click(event));
  }

  private move(event: PointerEvent): void {
    clearTimeout(this.timer);
    if (event.buttons !== 0 || event.pointerType === "touch") return;
    this.timer = window.setTimeout(() => this.point(event), REST);
  }

  private point(event: PointerEvent): void {
    const limit = pointed.peek() === null ? this.workspace.under(rayOf(this.stage, event)) : null;
    pointedLimit.value = limit;
    this.name.hidden = limit === null;
    if (limit === null) return;
    this.name.textContent = limitInWords(limit);
    const { left, top } = this.stage.canvas.getBoundingClientRect();
    this.name.style.translate = `${event.clientX - left + 14}px ${event.clientY - top + 10}px`;
  }

  private leave(): void {
    clearTimeout(this.timer);
    pointedLimit.value = null;
    this.name.hidden = true;
  }

  private click(event: PointerEvent): void {
    const from = this.pressed;
    this.pressed = null;
    if (!from || Math.hypot(event.clientX - from.clientX, event.clientY - from.clientY) > STILL) return;
    if (pointed.peek() !== null || measuring.peek()) return;
    const limit = this.workspace.under(rayOf(this.stage, event));
    keptLimit.value = limit === keptLimit.peek() ? null : limit;
  }
}
