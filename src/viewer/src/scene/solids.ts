/** Simple bodies, in the millimetres of the group they are put in. */

import {
  BoxGeometry,
  CylinderGeometry,
  EdgesGeometry,
  LineSegments,
  Mesh,
  SphereGeometry,
  Vector3,
  type BufferGeometry,
  type Material,
} from "three";
import type { Materials } from "./materials";

const Y = new Vector3(0, 1, 0);

/** A body with its edges drawn. */
export function edged(geometry: BufferGeometry, material: Material, materials: Materials): Mesh {
  const mesh = new Mesh(geometry, material);
  mesh.add(new LineSegments(new EdgesGeometry(geometry, 30), materials.edge));
  return mesh;
}

export function box(from: Vector3, to: Vector3, material: Material, materials: Materials): Mesh {
  const size = new Vector3().subVectors(to, from);
  const mesh = edged(
    new BoxGeometry(Math.abs(size.x), Math.abs(size.y), Math.abs(size.z)),
    material,
    materials,
  );
  mesh.position.addVectors(from, to).multiplyScalar(0.5);
  return mesh;
}

/** A cylinder of length 1 along its own y, to be laid between two points by `span`. */
export function bar(radius: number, material: Material, sides = 16): Mesh {
  return new Mesh(new CylinderGeometry(radius, radius, 1, sides), material);
}

export function ball(radius: number, material: Material): Mesh {
  return new Mesh(new SphereGeometry(radius, 16, 10), material);
}

export function span(bar: Mesh, from: Vector3, to: Vector3): void {
  const along = new Vector3().subVectors(to, from);
  const length = along.length();
  bar.position.addVectors(from, to).multiplyScalar(0.5);
  bar.scale.set(1, Math.max(length, 1e-6), 1);
  bar.quaternion.setFromUnitVectors(Y, along.divideScalar(length || 1));
}

/** A cylinder about the z axis between two heights. */
export function column(radii: [number, number], from: number, to: number, material: Material): Mesh {
  const geometry = new CylinderGeometry(radii[1], radii[0], Math.abs(to - from), 40);
  geometry.rotateX(Math.PI / 2);
  const mesh = new Mesh(geometry, material);
  mesh.position.z = (from + to) / 2;
  return mesh;
}
