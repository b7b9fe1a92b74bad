/** What moves above the table: sliders, rods, platform and tool; the same for the machine and its ghosts. */

import { ExtrudeGeometry, Group, Shape, Vector3, type Material, type Mesh } from "three";
import type { Limit, Machine, PlatformPose } from "verne-client";
import { baseFromPlatform } from "../geometry/frames";
import { joints, rods, type Rod, type Sliders } from "../geometry/rods";
import type { Materials } from "./materials";
import { ball, bar, box, column, edged, span } from "./solids";

/** The unit in which bodies without dimensions of their own are drawn: a thousandth of a rod. */
export function unitOf(g: Machine["geometry"]): number {
  return (g.L1 + g.L2 + g.L3) / 3000;
}

/** From the axis of a slider's joints to its guideway: leg I outwards along x, the others along y. */
export function outwards(g: Machine["geometry"], leg: 0 | 1 | 2): Vector3 {
  if (leg === 0) return new Vector3(Math.sign(g.d1 - g.D1), 0, 0);
  return new Vector3(0, leg === 1 ? -1 : 1, 0);
}

/** A slider's place with rho = 0, between its joints. */
export function sliderPlace(g: Machine["geometry"], leg: 0 | 1 | 2): Vector3 {
  if (leg === 0) return new Vector3(g.d1, 0, 0);
  return new Vector3(g.d2, leg === 1 ? -g.r4 : g.r4, 0);
}

export class Mechanism {
  readonly group = new Group();
  private readonly sliders: Mesh[];
  private readonly rods: { body: Mesh; ends: [Mesh, Mesh] }[];
  private readonly platform = new Group();
  private readonly plate: Mesh;
  private readonly toolPart = new Group();
  private toolLength = Number.NaN;
  private readonly unit: number;

  constructor(
    private readonly geometry: Machine["geometry"],
    private readonly materials: Materials,
  ) {
    this.unit = unitOf(geometry);
    const rest = joints(geometry);
    this.sliders = ([0, 1, 2] as const).map((leg) => this.slider(rest.filter((rod) => rod.leg === leg)));
    const radius = Math.max(geometry.rod_radius, 6 * this.unit);
    this.rods = rest.map(() => ({
      body: bar(radius, materials.rod),
      ends: [ball(radius * 1.35, materials.metal), ball(radius * 1.35, materials.metal)],
    }));
    this.plate = this.plateOf(rest);
    this.platform.matrixAutoUpdate = false;
    this.platform.add(
      this.plate,
      column([62 * this.unit, 62 * this.unit], -190 * this.unit, -20 * this.unit, materials.metal),
    );
    this.platform.add(this.toolPart);
    this.group.add(...this.sliders, ...this.rods.flatMap(({ body, ends }) => [body, ...ends]), this.platform);
  }

  place(rho: Sliders, pose: PlatformPose, tool: number): void {
    this.sliders.forEach((slider, i) => (slider.position.z = rho[i] ?? 0));
    rods(this.geometry, rho, pose).forEach((rod, i) => {
      const drawn = this.rods[i];
      if (!drawn) return;
      span(drawn.body, rod.slider, rod.platform);
      drawn.ends[0].position.copy(rod.slider);
      drawn.ends[1].position.copy(rod.platform);
    });
    this.platform.matrix.copy(baseFromPlatform(pose));
    this.platform.matrixWorldNeedsUpdate = true;
    this.lengthen(tool);
  }

  /** Sliders that stand where the machine's own stand are not drawn twice. */
  hideSliders(hidden: readonly boolean[]): void {
    this.sliders.forEach((slider, i) => (slider.visible = hidden[i] !== true));
  }

  /** Colours the part that a limit belongs to. */
  mark(limit: Limit | null, as: Material): void {
    const element = limit?.element ?? "";
    this.sliders.forEach(
      (slider, i) => (slider.material = element.startsWith(`slider${i + 1}.`) ? as : this.materials.metal),
    );
    joints(this.geometry).forEach((rod, i) => {
      const drawn = this.rods[i];
      if (drawn) drawn.body.material = names(element, rod) ? as : this.materials.rod;
    });
    this.plate.material = element === "platform" ? as : this.materials.platform;
  }

  private slider(rods: Rod[]): Mesh {
    const u = this.unit;
    const out = outwards(this.geometry, rods[0]?.leg ?? 0);
    const along = Math.abs(out.x) > 0 ? new Vector3(0, 1, 0) : new Vector3(1, 0, 0);
    const ends = rods.map((rod) => rod.slider.dot(along));
    const at = rods[0]?.slider.clone() ?? new Vector3();
    at.addScaledVector(along, -at.dot(along));
    const corner = (side: number, depth: number, height: number) =>
      at
        .clone()
        .addScaledVector(along, side)
        .addScaledVector(out, depth * u)
        .setZ(height * u);
    const from = corner(Math.min(...ends) - 45 * u, 8, -75);
    const to = corner(Math.max(...ends) + 45 * u, 80, 75);
    return box(from, to, this.materials.metal, this.materials);
  }

  /** A plate with the joints at its corners. */
  private plateOf(rods: Rod[]): Mesh {
    const corners = rods.map((rod) => rod.platform);
    const middle = corners.reduce((sum, at) => sum.add(at), new Vector3()).divideScalar(corners.length);
    const angle = (at: Vector3) => Math.atan2(at.y - middle.y, at.x - middle.x);
    const shape = new Shape();
    corners.sort((a, b) => angle(a) - angle(b));
    corners.forEach((at, i) => (i === 0 ? shape.moveTo(at.x, at.y) : shape.lineTo(at.x, at.y)));
    const depth = 40 * this.unit;
    const geometry = new ExtrudeGeometry(shape, { depth, bevelEnabled: false });
    geometry.translate(0, 0, -depth / 2);
    return edged(geometry, this.materials.platform, this.materials);
  }

  private lengthen(tool: number): void {
    if (tool === this.toolLength) return;
    this.toolLength = tool;
    this.toolPart.clear();
    if (tool <= 0) return;
    const u = this.unit;
    const point = Math.min(tool, 24 * u);
    const nose = Math.min(tool * 0.55, 70 * u);
    const { metal, tool: tip } = this.materials;
    this.toolPart.add(column([44 * u, 26 * u], 0, nose, metal));
    this.toolPart.add(
      column([9 * u, 9 * u], 0, tool - point, tip),
      column([9 * u, 0.5 * u], tool - point, tool, tip),
    );
  }
}

/** Whether a limit's element is, or counts for, this rod. */
function names(element: string, rod: Rod): boolean {
  if (element === `leg${rod.leg + 1}`) return true;
  if (element.startsWith("rods")) return element.slice(4).split("-").includes(rod.name);
  if (!element.startsWith("rod")) return false;
  const named = element.slice(3);
  return named === rod.name || (rod.leg > 0 && named[0] === rod.name[0]);
}
