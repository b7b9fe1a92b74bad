/** Axes with names: which way is which, z down in the base frame above all. */

import { ArrowHelper, Color, Group, Vector3 } from "three";
import { CSS2DObject } from "three/addons/renderers/CSS2DRenderer.js";
import type { Palette } from "./palette";

export class Triad {
  readonly group = new Group();
  private readonly arrows: ArrowHelper[];

  constructor(names: [string, string, string], length: number) {
    const axes = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)];
    this.arrows = axes.map((axis) => new ArrowHelper(axis, new Vector3(), length, 0x888888, length * 0.16, length * 0.07));
    axes.forEach((axis, i) => {
      const text = label(names[i] ?? "");
      text.position.copy(axis).multiplyScalar(length * 1.14);
      this.group.add(text);
    });
    this.group.add(...this.arrows);
  }

  paint(palette: Palette): void {
    for (const arrow of this.arrows) arrow.setColor(new Color(palette.ink));
  }
}

export function label(text: string, kind = "axis"): CSS2DObject {
  const element = document.createElement("span");
  element.className = `label ${kind}`;
  element.textContent = text;
  return new CSS2DObject(element);
}
