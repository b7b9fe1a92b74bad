/** The other positions of the machine, seen through, to be pointed at and picked. */

import { Group, Mesh, Raycaster, Vector2, type Material } from "three";
import type { CSS2DObject } from "three/addons/renderers/CSS2DRenderer.js";
import type { Machine } from "verne-client";
import type { Position } from "../state/store";
import { samePosition } from "../state/same";
import type { Materials } from "./materials";
import { Mechanism, sliderPlace } from "./mechanism";
import type { Stage } from "./stage";
import { label } from "./triads";

interface Ghost {
  mechanism: Mechanism;
  number: CSS2DObject;
}

export class Ghosts {
  readonly group = new Group();
  private drawn: Ghost[] = [];
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
      // A number inside of a group stays on the page when the group goes.
      for (const { number } of this.drawn) number.removeFromParent();
      this.drawn = [];
      this.group.clear();
    }
    while (this.drawn.length < positions.length) {
      const mechanism = new Mechanism(geometry, this.materials);
      const number = label(String(this.drawn.length + 1), "ghost");
      mechanism.group.add(number);
      this.drawn.push({ mechanism, number });
      this.group.add(mechanism.group);
    }
    this.drawn.forEach(({ mechanism, number }, i) => {
      const at = positions[i];
      mechanism.group.visible = at !== undefined && !(here && samePosition(at, here));
      if (!at) return;
      const { rho } = at.joints;
      const { platform, feasible } = at.solution;
      mechanism.place(rho, platform, tool);
      const same = rho.map(
        (value, slider) => Math.abs(value - (here?.joints.rho[slider] ?? Infinity)) < 1e-3,
      );
      mechanism.hideSliders(same);
      // Where it differs: at a slider of its own, or at the platform.
      const own = ([0, 1, 2] as const).find((slider) => same[slider] === false);
      if (own === undefined) number.position.set(platform.x, platform.y, platform.z);
      else number.position.copy(sliderPlace(geometry, own)).setZ(rho[own]);
      number.element.classList.toggle("broken", !feasible);
      const { pointedGhost, ghost, brokenGhost } = this.materials;
      dress(mechanism, i === pointed ? pointedGhost : feasible ? ghost : brokenGhost);
    });
  }

  /** The ghost under a point of the canvas, -1 to 1 both ways; null where there is none. */
  under(at: Vector2): number | null {
    this.ray.setFromCamera(at, this.stage.camera);
    let nearest: { ghost: number; distance: number } | null = null;
    this.drawn.forEach(({ mechanism: { group } }, ghost) => {
      if (!group.visible) return;
      const hit = this.ray.intersectObject(group, true).find(({ object }) => object instanceof Mesh);
      if (hit && (!nearest || hit.distance < nearest.distance)) nearest = { ghost, distance: hit.distance };
    });
    return (nearest as { ghost: number } | null)?.ghost ?? null;
  }
}

function dress({ group }: Mechanism, material: Material): void {
  group.traverse((part) => {
    if (part instanceof Mesh) part.material = material;
  });
}
