/** The camera that looks at the path. */

import {
  BufferAttribute,
  BufferGeometry,
  Mesh,
  Raycaster,
  Sphere,
  Vector3,
  type Group,
  type Material,
  type Object3D,
} from "three";
import type { Stage } from "../scene/stage";
import { change } from "../state/store";
import { plan } from "./program_state";

const METRES = 1e-3;
/** Directions that are tried around the normal of the table, and the sine of their height over it. */
const DIRECTIONS = 16;
const HEIGHT = 0.4;
/** Points of the path that should be seen. */
const SAMPLES = 12;

/** Looks at all of the path from above the table, where the machine hides little of it. */
export function framePath(stage: Stage, group: Group): void {
  const rows = plan.peek()?.rows;
  if (!rows || rows.count === 0) return;
  const places = new Float32Array(rows.tip.subarray(0, 3 * rows.count));
  const path = new BufferGeometry().setAttribute("position", new BufferAttribute(places, 3));
  path.computeBoundingSphere();
  const { center, radius } = path.boundingSphere ?? new Sphere();
  const ball = new Sphere(center.clone().applyMatrix4(group.matrix), Math.max(radius * METRES * 1.25, 0.02));
  const points = Array.from({ length: SAMPLES }, (_, i) => {
    const row = Math.floor((i * (rows.count - 1)) / (SAMPLES - 1));
    return new Vector3().fromArray(rows.tip, 3 * row).applyMatrix4(group.matrix);
  });
  stage.frame(ends(ball), bestDirection(stage, group, ball, points), false);
  change({ camera: stage.seen() });
}

/** The ends of a ball along the axes. */
function ends({ center, radius }: Sphere): Vector3[] {
  const axes = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)];
  return axes.flatMap((axis) =>
    [-radius, radius].map((along) => center.clone().addScaledVector(axis, along)),
  );
}

/** Among the directions in which most of the points are seen, the one that turns the camera least. */
function bestDirection(stage: Stage, group: Group, ball: Sphere, points: Vector3[]): Vector3 {
  const { camera, controls } = stage;
  const up = new Vector3(0, 0, 1).transformDirection(group.matrix);
  const now = camera.position.clone().sub(controls.target);
  const level = now.clone().addScaledVector(up, -now.dot(up));
  if (level.lengthSq() < 1e-12) level.set(1, 0, 0).transformDirection(group.matrix);
  level.normalize();
  const far = ball.radius / Math.sin(stage.angle / 2);
  const solid = solids(stage.scene, group);
  let best = { direction: level, cost: Infinity };
  for (let i = 0; i < DIRECTIONS; i += 1) {
    // 0, 1, -1, 2, -2, ...: the least turns first.
    const turn = (i % 2 === 1 ? 1 : -1) * Math.ceil(i / 2);
    const direction = level.clone().applyAxisAngle(up, (turn * 2 * Math.PI) / DIRECTIONS);
    direction.multiplyScalar(Math.sqrt(1 - HEIGHT ** 2)).addScaledVector(up, HEIGHT);
    const eye = ball.center.clone().addScaledVector(direction, far);
    const cost = points.filter((point) => isHidden(point, eye, solid)).length + 0.1 * Math.abs(turn);
    if (cost < best.cost) best = { direction, cost };
  }
  return best.direction;
}

function isHidden(point: Vector3, eye: Vector3, solid: Object3D[]): boolean {
  const way = point.clone().sub(eye);
  const ray = new Raycaster(eye, way.clone().normalize(), 0, way.length() - 1e-3);
  return ray.intersectObjects(solid, false).length > 0;
}

/** What hides the path: meshes that are seen and not seen through, and no lines. */
function solids(scene: Object3D, path: Group): Object3D[] {
  const found: Object3D[] = [];
  scene.traverseVisible((object) => {
    if (!(object instanceof Mesh) || object.parent?.parent === path) return;
    const material = object.material as Material | Material[];
    if (!Array.isArray(material) && !material.transparent) found.push(object);
  });
  return found;
}
