/** Coarser pictures while the machine draws too slowly for the hand that moves it; full ones at rest. */

import type { WebGLRenderer } from "three";

/** Time between pictures above which they become coarser, ms. */
const SLOW = 30;
/** Time after which the hand has stopped, ms. */
const REST = 200;
const LEAST = 0.5;

export class Resolution {
  private last = 0;
  private mean = 16;
  private factor = 1;
  /** What was fast enough when the hand moved last. */
  private learned = 1;
  private timer = 0;

  constructor(
    private readonly renderer: WebGLRenderer,
    private readonly redraw: () => void,
  ) {
    this.apply(1);
  }

  /** Tells that a picture was drawn. */
  drawn(now: number): void {
    const step = now - this.last;
    this.last = now;
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => this.rest(), REST);
    if (step > REST) return;
    if (this.factor > this.learned) this.apply(this.learned);
    this.mean += (step - this.mean) * 0.3;
    if (this.mean > SLOW && this.factor > LEAST) {
      this.mean = 16;
      this.learned = Math.max(LEAST, this.factor * 0.75);
      this.apply(this.learned);
    }
  }

  private rest(): void {
    if (this.factor === 1) return;
    this.apply(1);
    this.last = 0;
    this.redraw();
  }

  private apply(factor: number): void {
    this.factor = factor;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2) * factor);
  }
}
