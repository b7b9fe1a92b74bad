/** Axes with names: which way is which, z down in the base frame above all. */

import { ArrowHelper, Color, Group, Vector3 } from "three";
import { CSS2DObject } from "three/addons/renderers/CSS2DRenderer.js";
import type { Palette } from "./palette";

/** Length of an arrow's head. */
const HEAD = 40;

export class Triad {
  readonly group = new Group();
  private readonly arrows: ArrowHelper[];

  constructor(names: [string, string, string], lengths: [number, number, number]) {
    const axes = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)];
    this.arrows = axes.map(
      (axis, i) => new ArrowHelper(axis, new Vector3(), lengths[i], 0x888888, HEAD, HEAD * 0.45),
    );
    axes.forEach((axis, i) => {
      const text = label(names[i] ?? "");
      text.position.copy(axis).multiplyScalar((lengths[i] ?? 0) + HEAD);
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
