/** Quick pictures while the hand moves, good ones at rest. */

import type { WebGLRenderer } from "three";

/** Time between pictures above which they become coarser, ms. */
const SLOW = 30;
/** Time after which the hand has stopped, ms. */
const REST = 500;
const LEAST = 0.5;

export class Resolution {
  /** Whether pictures of a scene in the hand cannot be drawn in time as they are. */
  slow = false;
  /** Whether the next picture is one of a movement; the last one after it is good. */
  moving = false;
  private last = Number.NEGATIVE_INFINITY;
  private touched = Number.NEGATIVE_INFINITY;
  private mean = 0;
  private factor = 0;
  /** What was fast enough when the hand moved last. */
  private learned = 1;
  private timer = 0;

  /** `atRest`: pixels drawn for each that is shown, each way; more than one where the renderer smooths no edges. */
  constructor(
    private readonly renderer: WebGLRenderer,
    private readonly atRest: number,
    private readonly redraw: () => void,
  ) {
    this.apply(1);
    const touch = () => this.touch();
    for (const event of ["pointerdown", "wheel", "keydown", "input"])
      addEventListener(event, touch, { passive: true });
    addEventListener("pointermove", ({ buttons }) => buttons > 0 && touch(), { passive: true });
  }

  /** Tells that the hand, or a program that is played, moves the scene. */
  touch(): void {
    this.touched = performance.now();
  }

  /** Tells that a picture is about to be drawn. */
  prepare(now: number): void {
    const step = now - this.last;
    this.last = now;
    if (this.timer === 0 && this.moving) {
      this.moving = false;
      this.apply(this.atRest);
      return;
    }
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => this.rest(), REST);
    this.moving = true;
    const inHand = now - this.touched < REST;
    if (inHand && step < REST) this.judge(step);
    this.apply(inHand ? this.learned : 1);
  }

  private judge(step: number): void {
    this.mean = this.mean === 0 ? step : this.mean + (step - this.mean) * 0.25;
    if (this.mean <= SLOW) return;
    this.slow = true;
    this.mean = 0;
    this.learned = Math.max(LEAST, this.learned * 0.75);
  }

  private rest(): void {
    this.timer = 0;
    this.redraw();
  }

  /** Before a picture: the canvas is emptied by it. */
  private apply(factor: number): void {
    if (factor === this.factor) return;
    this.factor = factor;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2) * factor);
  }
}
