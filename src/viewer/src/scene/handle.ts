/** The arrows at the tool's tip: where they are dragged to is asked of /ik. */

import { Group, Matrix4, Object3D, Vector3, type Mesh } from "three";
import { TransformControls } from "three/addons/controls/TransformControls.js";
import type { Materials } from "./materials";
import { ball } from "./solids";
import type { Stage } from "./stage";
import { label } from "./triads";

export class Handle {
  readonly group = new Group();
  /** In the frame in which it is dragged. */
  private readonly grip = new Object3D();
  private readonly frame = new Group();
  private readonly controls: TransformControls;
  private readonly marker: Mesh;
  dragging = false;

  constructor(stage: Stage, materials: Materials, moved: (tip: Vector3) => void, released: () => void) {
    this.frame.matrixAutoUpdate = false;
    this.frame.add(this.grip);
    this.marker = ball(0.016, materials.marker);
    this.marker.renderOrder = 30;
    this.marker.visible = false;
    const text = label("wanted here: cannot be reached", "refused");
    text.center.set(0.5, -0.6);
    this.marker.add(text);
    this.controls = new TransformControls(stage.camera, stage.canvas);
    this.controls.setSpace("local");
    this.controls.setSize(0.62);
    stage.cameraTaken.push((camera) => (this.controls.camera = camera));
    // Arrows along the axes, and the plane of the table.
    this.controls.showYZ = false;
    this.controls.showXZ = false;
    this.controls.attach(this.grip);
    this.controls.addEventListener("change", () => stage.draw());
    this.controls.addEventListener("objectChange", () => moved(this.grip.position));
    this.controls.addEventListener("dragging-changed", ({ value }) => {
      this.dragging = value === true;
      stage.controls.enabled = !this.dragging;
      if (!this.dragging) released();
    });
    this.group.add(this.frame, this.controls.getHelper(), this.marker);
  }

  /** Puts the arrows at a tip of the frame, mm; not while they are held. */
  place(sceneFromFrame: Matrix4, tip: Vector3): void {
    this.frame.matrix.copy(sceneFromFrame);
    this.frame.matrixWorldNeedsUpdate = true;
    if (!this.dragging) this.grip.position.copy(tip);
    this.grip.updateMatrixWorld(true);
  }

  /** The tip in the scene. */
  tip(): Vector3 {
    return this.grip.getWorldPosition(new Vector3());
  }

  /** Marks where the tip was wanted and cannot be; scene metres. */
  mark(at: Vector3 | null): void {
    this.marker.visible = at !== null;
    if (at) this.marker.position.copy(at);
  }

  show(shown: boolean): void {
    this.controls.getHelper().visible = shown;
    this.controls.enabled = shown;
  }
}
