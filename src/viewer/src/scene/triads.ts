/** Axes with names: which way is which, z down in the base frame above all. */

import { ArrowHelper, Group, Vector3 } from "three";
import { CSS2DObject } from "three/addons/renderers/CSS2DRenderer.js";
import type { Materials } from "./materials";

/** Length of an arrow's head. */
const HEAD = 40;

export class Triad {
  readonly group = new Group();

  constructor(
    names: readonly [string, string, string],
    lengths: readonly [number, number, number],
    { axisLine, axisHead }: Materials,
  ) {
    const axes = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)];
    axes.forEach((axis, i) => {
      const arrow = new ArrowHelper(axis, new Vector3(), lengths[i], 0, HEAD, HEAD * 0.45);
      arrow.line.material = axisLine;
      arrow.cone.material = axisHead;
      const text = label(names[i] ?? "");
      text.position.copy(axis).multiplyScalar((lengths[i] ?? 0) + HEAD);
      this.group.add(arrow, text);
    });
  }
}

export function label(text: string, kind = "axis"): CSS2DObject {
  const element = document.createElement("span");
  element.className = `label ${kind}`;
  element.textContent = text;
  return new CSS2DObject(element);
}
