/** The other positions of the machine, seen through, to be pointed at and picked. */

import { Group, Mesh, Raycaster, Vector2 } from "three";
import type { Machine } from "verne-client";
import type { Position } from "../state/store";
import { samePosition } from "../state/same";
import type { Materials } from "./materials";
import { Mechanism } from "./mechanism";
import type { Stage } from "./stage";

export class Ghosts {
  readonly group = new Group();
  private drawn: Mechanism[] = [];
  private geometry: Machine["geometry"] | null = null;
  private readonly ray = new Raycaster();

  constructor(
    private readonly materials: Materials,
    private readonly stage: Stage,
  ) {}

  /** Shows those that are not where the machine itself is. */
  show(
    geometry: Machine["geometry"],
    positions: Position[],
    here: Position | null,
    tool: number,
    pointed: number | null,
  ): void {
    if (geometry !== this.geometry) {
      this.geometry = geometry;
      this.drawn = [];
      this.group.clear();
    }
    while (this.drawn.length < positions.length) {
      const ghost = new Mechanism(geometry, this.materials);
      this.drawn.push(ghost);
      this.group.add(ghost.group);
    }
    this.drawn.forEach((ghost, i) => {
      const at = positions[i];
      ghost.group.visible = at !== undefined && !(here && samePosition(at, here));
      if (!at) return;
      const { rho } = at.joints;
      ghost.place(rho, at.solution.platform, tool);
      ghost.hideSliders(
        rho.map((value, slider) => Math.abs(value - (here?.joints.rho[slider] ?? Infinity)) < 1e-3),
      );
      this.dress(ghost, i === pointed);
    });
  }

  /** The ghost under a point of the canvas, -1 to 1 both ways; null where there is none. */
  under(at: Vector2): number | null {
    this.ray.setFromCamera(at, this.stage.camera);
    let nearest: { ghost: number; distance: number } | null = null;
    this.drawn.forEach(({ group }, ghost) => {
      if (!group.visible) return;
      const hit = this.ray.intersectObject(group, true).find(({ object }) => object instanceof Mesh);
      if (hit && (!nearest || hit.distance < nearest.distance)) nearest = { ghost, distance: hit.distance };
    });
    return (nearest as { ghost: number } | null)?.ghost ?? null;
  }

  private dress(ghost: Mechanism, pointed: boolean): void {
    const material = pointed ? this.materials.pointedGhost : this.materials.ghost;
    ghost.group.traverse((part) => {
      if (part instanceof Mesh) part.material = material;
    });
  }
}
