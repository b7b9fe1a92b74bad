/** Where the scene is seen from: the whole machine from a side, or as the address says. */

import { effect } from "@preact/signals";
import { Vector3 } from "three";
import { camera, change, machine } from "../state/store";
import type { Camera } from "../state/view";
import type { Stage } from "./stage";
import { extent } from "./surroundings";

export type Side = "whole" | "front" | "side" | "top";
const FROM: Record<Side, Vector3> = {
  whole: new Vector3(0.5, 0.36, 1),
  front: new Vector3(0, 0.02, 1),
  side: new Vector3(1, 0.02, 0),
  top: new Vector3(0, 1, 0.001),
};

export class Viewpoint {
  /** Whether the scene is seen from a side; such a view needs no camera in the address. */
  private aside = false;

  constructor(private readonly stage: Stage) {
    const tell = () => change({ camera: rounded(stage.seen()) });
    stage.controls.addEventListener("end", tell);
    // The controls do not tell when a key has moved the camera.
    stage.canvas.addEventListener("keyup", ({ key }) => key.startsWith("Arrow") && tell());
    effect(() => {
      if (machine.value && !camera.peek()) this.from("whole");
    });
    effect(() => {
      const seen = camera.value;
      if (seen) {
        this.aside = false;
        stage.look(seen);
      } else if (!this.aside) this.from("whole");
    });
  }

  /** Looks at the machine from a side, all of it. */
  from(side: Side): void {
    const definition = machine.peek()?.definition;
    if (!definition) return;
    const { top, floor } = extent(definition);
    const middle = -(top + floor) / 2000;
    this.stage.frame(new Vector3(0, middle, 0), ((floor - top) / 2000) * 1.13, FROM[side]);
    this.aside = true;
    change({ camera: null });
  }
}

function rounded({ eye, target }: Camera): Camera {
  const round = ([x, y, z]: Camera["eye"]): Camera["eye"] => [thousandth(x), thousandth(y), thousandth(z)];
  return { eye: round(eye), target: round(target) };
}

function thousandth(value: number): number {
  return Math.round(value * 1000) / 1000;
}
