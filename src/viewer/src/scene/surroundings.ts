/** What stands still, and the table: columns with guideways, floor, cradle and turntable. */

import { BufferGeometry, GridHelper, Group, LineSegments, Vector3, type Material, type Mesh } from "three";
import type { Machine } from "verne-client";
import { baseFromCradle, baseFromTable, type TableAngles } from "../geometry/frames";
import type { Materials } from "./materials";
import { outwards, unitOf } from "./mechanism";
import { bar, box, column, span } from "./solids";

/** The heights of the columns' upper ends and of the floor, base frame, mm. */
function extent({ geometry, table, limits }: Machine): { top: number; floor: number } {
  const u = unitOf(geometry);
  return {
    top: Math.min(...limits.stroke.map(([low = 0]) => low)) - 160 * u,
    floor: table.da + Math.max(Math.abs(table.dt) + 180 * u, 470 * u),
  };
}

/** The cosine of the angle to the camera within which a column is in front. */
const IN_FRONT = 0.8;

export class Surroundings {
  readonly group = new Group();
  private readonly floor: number;
  private readonly top: number;
  private readonly cradle = new Group();
  private readonly turntable = new Group();
  private readonly unit: number;
  /** What can stand in front of the machine, with the direction from the machine to it. */
  private readonly fronts: { out: Vector3; bodies: Mesh[]; material: Material }[] = [];

  constructor(
    private readonly machine: Machine,
    private readonly materials: Materials,
  ) {
    this.unit = unitOf(machine.geometry);
    const { top, floor } = extent(machine);
    this.floor = floor;
    this.top = top;
    for (const part of [this.cradle, this.turntable]) part.matrixAutoUpdate = false;
    this.group.add(this.cradle, this.turntable, ...this.columns(), ...this.posts(), this.grid());
    this.build();
    this.turn({ theta1: 0, theta2: 0 });
  }

  turn(angles: TableAngles): void {
    const { table } = this.machine;
    this.cradle.matrix.copy(baseFromCradle(table, angles.theta1));
    this.turntable.matrix.copy(baseFromTable(table, angles));
    for (const part of [this.cradle, this.turntable]) part.matrixWorldNeedsUpdate = true;
  }

  /** Sees through the columns and posts on the side of a camera in this direction of the base frame; null: through none. */
  clear(camera: Vector3 | null): void {
    for (const { out, bodies, material } of this.fronts) {
      const inFront = camera !== null && out.dot(camera) > IN_FRONT;
      for (const body of bodies) body.material = inFront ? this.materials.faded : material;
    }
  }

  /** Columns behind the sliders, each with its guideway over the stroke, and beams between their heads. */
  private columns() {
    const { geometry: g, limits } = this.machine;
    const { unit: u, materials } = this;
    const feet = ([0, 1, 2] as const).map((leg) => {
      const at = leg === 0 ? new Vector3(g.d1, 0, 0) : new Vector3(g.d2, leg === 1 ? -g.r4 : g.r4, 0);
      return { at, out: outwards(g, leg), stroke: limits.stroke[leg] ?? [0, 0] };
    });
    const heads: Vector3[] = [];
    const parts = feet.flatMap(({ at, out, stroke: [low = 0, high = 0] }) => {
      const middle = at.clone().addScaledVector(out, 128 * u);
      const half = new Vector3(30 * u, 30 * u, 0);
      const post = box(
        middle.clone().sub(half).setZ(this.top),
        middle.clone().add(half).setZ(this.floor),
        materials.frame,
        materials,
      );
      const rail = at.clone().addScaledVector(out, 89 * u);
      const side = new Vector3(Math.abs(out.y), Math.abs(out.x), 0)
        .multiplyScalar(22 * u)
        .addScaledVector(out, 9 * u);
      const guideway = box(
        rail
          .clone()
          .sub(side)
          .setZ(low - 75 * u),
        rail
          .clone()
          .add(side)
          .setZ(high + 75 * u),
        materials.metal,
        materials,
      );
      heads.push(middle.setZ(this.top + 30 * u));
      this.fronts.push({ out, bodies: [post], material: materials.frame });
      this.fronts.push({ out, bodies: [guideway], material: materials.metal });
      return [post, guideway];
    });
    const beams = [
      [0, 1],
      [1, 2],
      [2, 0],
    ].map(([i = 0, j = 0]) => {
      const beam = bar(26 * u, materials.frame, 4);
      span(beam, heads[i] ?? new Vector3(), heads[j] ?? new Vector3());
      return beam;
    });
    return [...parts, ...beams];
  }

  private posts() {
    const { unit: u, materials } = this;
    const { da } = this.machine.table;
    return [-1, 1].map((side) => {
      const post = box(
        new Vector3(side * 455 * u, -70 * u, da - 60 * u),
        new Vector3(side * 515 * u, 70 * u, this.floor),
        materials.frame,
        materials,
      );
      this.fronts.push({ out: new Vector3(side, 0, 0), bodies: [post], material: materials.frame });
      return post;
    });
  }

  private grid() {
    const size = 3200 * this.unit;
    const grid = new GridHelper(size, 16);
    grid.material = this.materials.grid;
    grid.rotation.x = Math.PI / 2;
    grid.position.z = this.floor;
    return grid;
  }

  private build(): void {
    const { unit: u, materials } = this;
    const { dt } = this.machine.table;
    const { table, metal } = materials;
    const under = dt + 44 * u;
    for (const side of [-1, 1]) {
      const cheek = box(
        new Vector3(side * 365 * u, -75 * u, -75 * u),
        new Vector3(side * 410 * u, 75 * u, under + 60 * u),
        table,
        materials,
      );
      const shaft = bar(38 * u, metal, 24);
      span(shaft, new Vector3(side * 405 * u, 0, 0), new Vector3(side * 470 * u, 0, 0));
      this.cradle.add(cheek, shaft);
    }
    this.cradle.add(
      box(
        new Vector3(-365 * u, -110 * u, under + 4 * u),
        new Vector3(365 * u, 110 * u, under + 60 * u),
        table,
        materials,
      ),
    );
    // The table frame's z points up, away from the disc.
    this.turntable.add(column([330 * u, 330 * u], -44 * u, 0, metal), this.slots());
  }

  private slots() {
    const { unit: u } = this;
    const points: Vector3[] = [];
    for (let i = 0; i < 8; i += 1) {
      const [x, y] = [Math.cos((i * Math.PI) / 4), Math.sin((i * Math.PI) / 4)];
      points.push(new Vector3(60 * u * x, 60 * u * y, u), new Vector3(320 * u * x, 320 * u * y, u));
    }
    return new LineSegments(new BufferGeometry().setFromPoints(points), this.materials.slot);
  }
}
