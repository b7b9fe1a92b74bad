/** The names in the scene, as text over the canvas; none covers another one. */

import { CSS2DObject, CSS2DRenderer } from "three/addons/renderers/CSS2DRenderer.js";
import { Vector3, type Object3D } from "three";
import type { Stage } from "./stage";

interface Box {
  left: number;
  top: number;
  width: number;
  height: number;
}

/** The kinds of labels, those that are placed first in front. */
const ORDER = ["refused", "measure", "ghost", "knob", "axis", "slider"];
/** Places that are tried, in heights of the label: the label's own, then around it. */
const SHIFTS = [
  [0, 0],
  [0, 1.1],
  [0, -1.1],
  [1.6, 0],
  [-1.6, 0],
  [1.6, 1.1],
  [-1.6, -1.1],
  [0, 2.2],
  [0, -2.2],
  [1.6, -2.2],
  [-1.6, 2.2],
] as const;

export class LabelLayer {
  private readonly renderer: CSS2DRenderer;
  /** Sizes of texts: measuring costs a layout. */
  private readonly sizes = new Map<string, [number, number]>();

  constructor(
    private readonly stage: Stage,
    private readonly element: HTMLElement,
  ) {
    this.renderer = new CSS2DRenderer({ element });
  }

  draw(): void {
    const { clientWidth, clientHeight } = this.stage.canvas;
    const size = this.renderer.getSize();
    if (size.width !== clientWidth || size.height !== clientHeight)
      this.renderer.setSize(clientWidth, clientHeight);
    this.renderer.render(this.stage.scene, this.stage.camera);
    this.separate(clientWidth, clientHeight);
  }

  /** Moves labels that would cover others; hides those for which there is no place. */
  private separate(width: number, height: number): void {
    const placed: Box[] = this.captions();
    const labels: CSS2DObject[] = [];
    this.stage.scene.traverseVisible((node: Object3D) => {
      if (node instanceof CSS2DObject) labels.push(node);
    });
    labels.sort((a, b) => order(a) - order(b));
    for (const label of labels) {
      const { element, center } = label;
      const at = label.getWorldPosition(new Vector3()).project(this.stage.camera);
      const [w, h] = this.size(element);
      const left = ((at.x + 1) / 2) * width - center.x * w;
      const top = ((1 - at.y) / 2) * height - center.y * h;
      const box = ([x, y]: readonly [number, number]) => ({
        left: left + x * h,
        top: top + y * h,
        width: w,
        height: h,
      });
      const shift = SHIFTS.find((tried) => !placed.some((other) => overlap(box(tried), other)));
      element.style.visibility = shift ? "" : "hidden";
      if (!shift) continue;
      element.style.translate = shift[0] || shift[1] ? `${shift[0] * h}px ${shift[1] * h}px` : "";
      placed.push(box(shift));
    }
  }

  private size(element: HTMLElement): [number, number] {
    const key = `${element.className} ${element.textContent}`;
    const known = this.sizes.get(key);
    if (known) return known;
    const size: [number, number] = [element.offsetWidth, element.offsetHeight];
    if (size[0] > 0) this.sizes.set(key, size);
    return size;
  }

  /** What the page writes over the scene. */
  private captions(): Box[] {
    const scene = this.element.parentElement;
    if (!scene) return [];
    const origin = scene.getBoundingClientRect();
    return [...scene.querySelectorAll(".caption, .notice, .below > *")].map((caption) => {
      const { left, top, width, height } = caption.getBoundingClientRect();
      return { left: left - origin.left, top: top - origin.top, width, height };
    });
  }
}

function order({ element }: CSS2DObject): number {
  return ORDER.findIndex((kind) => element.classList.contains(kind));
}

function overlap(a: Box, b: Box): boolean {
  return (
    a.left < b.left + b.width &&
    b.left < a.left + a.width &&
    a.top < b.top + b.height &&
    b.top < a.top + a.height
  );
}
