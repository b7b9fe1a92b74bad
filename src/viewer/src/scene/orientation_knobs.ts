/** Two knobs at the tool's tip: one on a circle turns the tool about the table's axis (phi2), one inclines it (phi1). */

import { BufferGeometry, Group, Line, LineLoop, Matrix4, Mesh, Plane, SphereGeometry, Vector3 } from "three";
import { azimuth, phi1Towards, phi2Towards, toolAxis } from "../geometry/orientation";
import type { Materials } from "./materials";
import { rayOf } from "./pointing";
import type { Stage } from "./stage";
import { label } from "./triads";

type Angle = "phi1" | "phi2";
export interface Angles {
  phi1: number;
  phi2: number;
}

/** Size in thousandths of a rod: of the circle, of a knob, and of what the pointer may touch. */
const RADIUS = 290;
const KNOB = 13;
const TOUCHED = 34;
const POINTS = 96;

export class OrientationKnobs {
  /** In the part frame with its origin at the tip, mm. */
  readonly group = new Group();
  private readonly knobs: Record<Angle, Mesh>;
  private readonly arc: Line;
  private angles: Angles = { phi1: 0, phi2: 0 };
  private held: Angle | null = null;

  constructor(
    private readonly stage: Stage,
    private readonly materials: Materials,
    private readonly turned: (angles: Angles) => void,
  ) {
    this.group.matrixAutoUpdate = false;
    this.knobs = { phi1: this.knob("φ₁"), phi2: this.knob("φ₂") };
    const circle = new LineLoop(
      curve((turn) => azimuth(360 * turn)),
      materials.guide,
    );
    this.arc = new Line(new BufferGeometry(), materials.guide);
    for (const line of [circle, this.arc]) line.renderOrder = 28;
    this.group.add(circle, this.arc, this.knobs.phi1, this.knobs.phi2);
    const { canvas } = stage;
    // Before the camera's controls: a knob that is pressed turns the tool only.
    canvas.addEventListener("pointerdown", (event) => this.press(event), { capture: true });
    canvas.addEventListener("pointermove", (event) => this.move(event), { capture: true });
    for (const end of ["pointerup", "pointercancel"] as const)
      canvas.addEventListener(end, () => this.release(), { capture: true });
  }

  /** Puts the knobs at a tip; while one is held, it stays in the hand. */
  place(sceneFromPart: Matrix4, tip: Vector3, angles: Angles, unit: number): void {
    this.group.matrix.copy(sceneFromPart).multiply(new Matrix4().makeTranslation(tip));
    this.group.matrix.scale(new Vector3(unit, unit, unit));
    this.group.matrixWorldNeedsUpdate = true;
    if (!this.held) this.show(angles);
  }

  /** Where the knobs are in the scene: for tests that drag them. */
  seen(angle: Angle): Vector3 {
    return this.knobs[angle].getWorldPosition(new Vector3()).project(this.stage.camera);
  }

  private show(angles: Angles): void {
    this.angles = angles;
    const { phi1, phi2 } = angles;
    this.knobs.phi2.position.copy(azimuth(phi2)).multiplyScalar(RADIUS);
    this.knobs.phi1.position.copy(toolAxis(phi1, phi2)).multiplyScalar(RADIUS);
    this.arc.geometry.dispose();
    this.arc.geometry = curve((part) => toolAxis(180 * part - 90, phi2));
    this.stage.draw();
  }

  private knob(name: string): Mesh {
    const knob = new Mesh(new SphereGeometry(KNOB, 20, 12), this.materials.knob);
    knob.renderOrder = 29;
    const text = label(name, "knob");
    text.center.set(-0.7, 0.5);
    knob.add(text);
    return knob;
  }

  private touched(event: PointerEvent): Angle | null {
    if (!this.group.visible) return null;
    const { ray } = rayOf(this.stage, event);
    const radius = TOUCHED * this.knobs.phi1.getWorldScale(new Vector3()).x;
    const near = (["phi1", "phi2"] as const)
      .map((angle) => ({
        angle,
        distance: ray.distanceToPoint(this.knobs[angle].getWorldPosition(new Vector3())),
      }))
      .filter(({ distance }) => distance < radius)
      .sort((a, b) => a.distance - b.distance);
    return near[0]?.angle ?? null;
  }

  private press(event: PointerEvent): void {
    if (event.button !== 0) return;
    this.held = this.touched(event);
    if (!this.held) return;
    event.stopImmediatePropagation();
    event.preventDefault();
    this.stage.canvas.setPointerCapture(event.pointerId);
  }

  private move(event: PointerEvent): void {
    const { style } = this.stage.canvas;
    if (!this.held) {
      if (event.buttons === 0) style.cursor = this.touched(event) ? "grab" : "";
      return;
    }
    event.stopImmediatePropagation();
    const direction = this.direction(event, this.held);
    if (!direction) return;
    const { phi1, phi2 } = this.angles;
    const next =
      this.held === "phi2"
        ? { phi1, phi2: tenth(phi2Towards(direction, phi2)) }
        : { phi1: tenth(phi1Towards(direction, phi2, phi1)), phi2 };
    this.show(next);
    this.turned(next);
  }

  private release(): void {
    this.held = null;
  }

  /** From the tip to the pointer in the held knob's plane, part frame; null where the plane is seen edge-on. */
  private direction(event: PointerEvent, angle: Angle): Vector3 | null {
    const normal = angle === "phi2" ? new Vector3(0, 0, 1) : azimuth(this.angles.phi2 + 90);
    const plane = new Plane(normal, 0).applyMatrix4(this.group.matrixWorld);
    const { ray } = rayOf(this.stage, event);
    if (Math.abs(ray.direction.dot(plane.normal)) < 0.05) return null;
    const point = ray.intersectPlane(plane, new Vector3());
    return point?.applyMatrix4(this.group.matrixWorld.clone().invert()) ?? null;
  }
}

/** Angles are dragged in tenths of a degree. */
function tenth(angle: number): number {
  return Math.round(angle * 10) / 10 + 0;
}

function curve(direction: (part: number) => Vector3): BufferGeometry {
  const points = Array.from({ length: POINTS + 1 }, (_, i) => direction(i / POINTS).multiplyScalar(RADIUS));
  return new BufferGeometry().setFromPoints(points);
}
