/** The arrows at the tool's tip follow the position, and tell where the hand drags them. */

import { effect } from "@preact/signals";
import { Matrix4, Vector3 } from "three";
import { sceneFromFrame } from "../geometry/frames";
import { moveTo } from "../state/motion";
import { drag, machine, position, refusal } from "../state/store";
import { wantedTip } from "../state/target";
import { Handle } from "./handle";
import type { Materials } from "./materials";
import type { Stage } from "./stage";

export class TipControl {
  private readonly handle: Handle;

  constructor(
    private readonly stage: Stage,
    materials: Materials,
  ) {
    this.handle = new Handle(stage, materials, dragged, () => this.place());
    effect(() => {
      this.place();
      this.mark();
      stage.draw();
    });
  }

  /** In the scene, metres. */
  get group() {
    return this.handle.group;
  }

  /** Writes where the tip is seen, -1 to 1 both ways: for tests that drag it. */
  tell(): void {
    const [u, v] = this.handle.tip().project(this.stage.camera).toArray();
    this.stage.canvas.dataset["tip"] = `${u.toFixed(4)},${v.toFixed(4)}`;
  }

  private place(): void {
    const at = position.value;
    if (!at) return;
    const part = drag.value === "part";
    const tip = part ? at.solution.part : at.solution.tool;
    if (tip) this.handle.place(sceneFrom(part ? "part" : "base"), new Vector3(tip.x, tip.y, tip.z));
  }

  private mark(): void {
    const refused = refusal.value;
    const missed = refused && wantedTip(refused.target);
    this.handle.mark(
      missed ? new Vector3(missed.x, missed.y, missed.z).applyMatrix4(sceneFrom(missed.frame)) : null,
    );
  }
}

function dragged(tip: Vector3): void {
  const [x, y, z] = tip.toArray();
  const part = position.peek()?.solution.part;
  if (drag.peek() === "part" && part) {
    moveTo({ by: "part", pose: { x, y, z, phi1: part.phi1, phi2: part.phi2 } });
  } else {
    moveTo({ by: "tool", pose: { x, y, z } });
  }
}

function sceneFrom(frame: "base" | "part"): Matrix4 {
  return sceneFromFrame(frame, machine.peek()?.definition.table, position.peek()?.joints);
}
