/** Where the scene is seen from: the whole machine, one of its sides, or as the address says. */

import { effect } from "@preact/signals";
import { Mesh, Vector3, type BufferGeometry, type Object3D } from "three";
import { equal } from "../state/equal";
import { camera, change, machine } from "../state/store";
import type { Camera } from "../state/view";
import { outwards, unitOf } from "./mechanism";
import type { Stage } from "./stage";

export type Side = "whole" | "front" | "side" | "top";

export class Viewpoint {
  /** Whether the whole is seen; this view needs no camera in the address. */
  private whole = false;

  constructor(
    private readonly stage: Stage,
    /** What has to be seen: the machine and its ghosts. */
    private readonly bodies: Object3D[],
  ) {
    const tell = () => {
      this.whole = false;
      change({ camera: rounded(stage.seen()) });
    };
    stage.controls.addEventListener("end", tell);
    // The controls do not tell when a key has moved the camera.
    stage.canvas.addEventListener("keyup", ({ key }) => key.startsWith("Arrow") && tell());
    effect(() => {
      const geometry = machine.value?.definition.geometry;
      if (!geometry) return;
      stage.reach(unitOf(geometry));
      if (!camera.peek()) this.from("whole");
    });
    effect(() => {
      const seen = camera.value;
      if (seen) {
        this.whole = false;
        if (!equal(seen, rounded(stage.seen()))) stage.look(seen);
      } else if (!this.whole) this.from("whole");
    });
  }

  /** Looks at the machine and its ghosts, all of them: in perspective, or along an axis without it. */
  from(side: Side): void {
    const geometry = machine.peek()?.definition.geometry;
    if (!geometry) return;
    // Leg 1 stands alone on its side: its column would be in the middle of the picture.
    const away = outwards(geometry, 0).x > 0 ? -1 : 1;
    const from = {
      whole: new Vector3(0.5, 0.36, 1),
      front: new Vector3(0, 0, 1),
      side: new Vector3(away, 0, 0),
      top: new Vector3(0, 1, 1e-4),
    }[side];
    this.stage.scene.updateMatrixWorld(true);
    this.stage.frame(this.bodies.flatMap(corners), from, side !== "whole");
    this.whole = side === "whole";
    change({ camera: this.whole ? null : rounded(this.stage.seen()) });
  }
}

/** The corners of the boxes around what is visible of a body, in the scene. */
function corners(body: Object3D): Vector3[] {
  const found: Vector3[] = [];
  body.traverseVisible((part) => {
    if (!(part instanceof Mesh)) return;
    const geometry = part.geometry as BufferGeometry;
    if (!geometry.boundingBox) geometry.computeBoundingBox();
    const { min, max } = geometry.boundingBox ?? {};
    if (!min || !max) return;
    for (const x of [min.x, max.x])
      for (const y of [min.y, max.y])
        for (const z of [min.z, max.z]) found.push(new Vector3(x, y, z).applyMatrix4(part.matrixWorld));
  });
  return found;
}

function rounded({ eye, target, height }: Camera): Camera {
  const round = ([x, y, z]: Camera["eye"]): Camera["eye"] => [thousandth(x), thousandth(y), thousandth(z)];
  return { eye: round(eye), target: round(target), height: height === null ? null : thousandth(height) };
}

function thousandth(value: number): number {
  return Math.round(value * 1000) / 1000 + 0;
}
