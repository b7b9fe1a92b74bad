/** Points that the operator clicks to measure: on the surfaces that are seen, or at joints, tip and platform nearby. */

import { effect } from "@preact/signals";
import { BufferGeometry, Group, Line, Mesh, SphereGeometry, Vector2, Vector3, type Object3D } from "three";
import { SCENE_FROM_BASE } from "../geometry/frames";
import { rods } from "../geometry/rods";
import { measured, measurement, measuring, take, toggleMeasuring } from "../state/measurement";
import { machine, position } from "../state/store";
import { mm } from "../words/numbers";
import type { Materials } from "./materials";
import { unitOf } from "./mechanism";
import { onCanvas, rayOf } from "./pointing";
import type { Stage } from "./stage";
import { label } from "./triads";

/** A press that moves farther turns the camera, px. */
const STILL = 4;
/** How near the pointer comes to a joint to mean it, px. */
const SNAP = 12;

export class Measure {
  /** In the base frame, mm. */
  readonly group = new Group();
  private readonly line: Line;
  private readonly ends: [Mesh, Mesh];
  private readonly text = label("", "measure");

  constructor(
    private readonly stage: Stage,
    materials: Materials,
  ) {
    const ball = () => new Mesh(new SphereGeometry(9, 16, 10), materials.knob);
    this.line = new Line(new BufferGeometry(), materials.guide);
    this.ends = [ball(), ball()];
    for (const part of [this.line, ...this.ends]) part.renderOrder = 31;
    this.group.add(this.line, ...this.ends, this.text);
    const pressed = new Vector2();
    stage.canvas.addEventListener("pointerdown", ({ clientX, clientY }) => pressed.set(clientX, clientY));
    stage.canvas.addEventListener("pointerup", (event) => {
      const still = pressed.distanceTo(new Vector2(event.clientX, event.clientY)) <= STILL;
      if (measuring.peek() && still) this.click(event);
    });
    stage.canvas.addEventListener("keydown", ({ key }) => {
      if (key === "Escape" && measuring.peek()) toggleMeasuring();
    });
    effect(() => this.show());
  }

  private show(): void {
    const points = (measured.value ?? []).map((point) => new Vector3(...point));
    const geometry = machine.peek()?.definition.geometry;
    this.ends.forEach((end, i) => {
      const at = points[i];
      end.visible = at !== undefined;
      if (geometry) end.scale.setScalar(unitOf(geometry));
      if (at) end.position.copy(at);
    });
    const found = measurement.value;
    this.line.visible = this.text.visible = found !== null;
    if (found) {
      this.line.geometry.dispose();
      this.line.geometry = new BufferGeometry().setFromPoints(points);
      this.text.element.textContent = mm(found.distance);
      this.text.position.copy(points.reduce((sum, at) => sum.add(at), new Vector3())).multiplyScalar(0.5);
    }
    this.stage.draw();
  }

  private click(event: PointerEvent): void {
    const at = this.near(event) ?? this.seen(event);
    if (at) take(at.toArray());
  }

  /** The joint, tip or platform point under the pointer, base frame. */
  private near(event: PointerEvent): Vector3 | null {
    const here = position.peek();
    const geometry = machine.peek()?.definition.geometry;
    if (!here || !geometry) return null;
    const { platform, tool } = here.solution;
    const joints = rods(geometry, here.joints.rho, platform).flatMap((rod) => [rod.slider, rod.platform]);
    const points = [
      new Vector3(tool.x, tool.y, tool.z),
      new Vector3(platform.x, platform.y, platform.z),
      ...joints,
    ];
    const pointer = onCanvas(this.stage.canvas, event);
    const { clientWidth, clientHeight } = this.stage.canvas;
    const distance = (point: Vector3) => {
      const { x, y } = point.clone().applyMatrix4(SCENE_FROM_BASE).project(this.stage.camera);
      return Math.hypot(((x - pointer.x) * clientWidth) / 2, ((y - pointer.y) * clientHeight) / 2);
    };
    const [nearest] = points.sort((a, b) => distance(a) - distance(b));
    return nearest && distance(nearest) < SNAP ? nearest : null;
  }

  /** The nearest surface under the pointer, base frame. */
  private seen(event: PointerEvent): Vector3 | null {
    const bodies: Object3D[] = [];
    this.stage.scene.traverseVisible((part) => {
      if (part instanceof Mesh && solid(part as Mesh)) bodies.push(part);
    });
    const [hit] = rayOf(this.stage, event).intersectObjects(bodies, false);
    return hit ? hit.point.clone().applyMatrix4(SCENE_FROM_BASE.clone().invert()) : null;
  }
}

/** Handles and columns that are seen through are not measured. */
function solid({ material }: Mesh): boolean {
  const one = Array.isArray(material) ? material[0] : material;
  return one !== undefined && one.depthTest && one.opacity > 0.1;
}
