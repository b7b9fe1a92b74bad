/** The names in the scene, as text over the canvas. */

import { CSS2DRenderer } from "three/addons/renderers/CSS2DRenderer.js";
import type { Stage } from "./stage";

export class LabelLayer {
  private readonly renderer: CSS2DRenderer;

  constructor(
    private readonly stage: Stage,
    element: HTMLElement,
  ) {
    this.renderer = new CSS2DRenderer({ element });
  }

  draw(): void {
    const { clientWidth, clientHeight } = this.stage.canvas;
    const size = this.renderer.getSize();
    if (size.width !== clientWidth || size.height !== clientHeight)
      this.renderer.setSize(clientWidth, clientHeight);
    this.renderer.render(this.stage.scene, this.stage.camera);
  }
}
