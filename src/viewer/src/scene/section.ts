/** The slice, drawn in the frame of its workspace. */

import { BufferGeometry, Group, LineLoop, Mesh, Path, Shape, ShapeGeometry, Vector2 } from "three";
import type { Slice } from "verne-client";
import type { Materials } from "./materials";

export class Section {
  /** In the workspace's frame, mm. */
  readonly group = new Group();

  constructor(private readonly materials: Materials) {
    this.group.matrixAutoUpdate = false;
  }

  show(slice: Slice | null): void {
    for (const part of this.group.children) {
      if (part instanceof Mesh || part instanceof LineLoop) (part.geometry as BufferGeometry).dispose();
    }
    this.group.clear();
    for (const { outer, holes } of slice?.polygons ?? []) {
      const shape = new Shape(points(outer));
      shape.holes = holes.map((hole) => new Path(points(hole)));
      const fill = new Mesh(new ShapeGeometry(shape), this.materials.cutFill);
      fill.renderOrder = 20;
      const lines = [outer, ...holes].map((ring) => {
        const line = new LineLoop(new BufferGeometry().setFromPoints(points(ring)), this.materials.cutLine);
        line.renderOrder = 21;
        return line;
      });
      for (const part of [fill, ...lines]) {
        part.position.z = slice?.z ?? 0;
        this.group.add(part);
      }
    }
  }
}

function points(ring: number[][]): Vector2[] {
  return ring.map(([x = 0, y = 0]) => new Vector2(x, y));
}
