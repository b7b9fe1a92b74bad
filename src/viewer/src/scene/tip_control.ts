/** The arrows at the tool's tip follow the position, and tell where the hand drags them. */

import { effect } from "@preact/signals";
import { Group, Matrix4, Vector3 } from "three";
import { sceneFromFrame } from "../geometry/frames";
import { measuring } from "../state/measurement";
import { moveTo } from "../state/motion";
import { drag, machine, position, refusal } from "../state/store";
import { wantedTip } from "../state/target";
import { Handle } from "./handle";
import type { Materials } from "./materials";
import { unitOf } from "./mechanism";
import { OrientationKnobs, type Angles } from "./orientation_knobs";
import type { Stage } from "./stage";

export class TipControl {
  /** In the scene, metres. */
  readonly group = new Group();
  private readonly handle: Handle;
  private readonly knobs: OrientationKnobs;

  constructor(
    private readonly stage: Stage,
    materials: Materials,
  ) {
    this.handle = new Handle(stage, materials, dragged, () => this.place());
    this.knobs = new OrientationKnobs(stage, materials, turned);
    this.group.add(this.handle.group, this.knobs.group);
    effect(() => {
      this.place();
      this.mark();
      // A click measures, whatever it hits.
      this.handle.show(!measuring.value);
      stage.draw();
    });
  }

  /** Writes where tip and knobs are seen, -1 to 1 both ways: for tests that drag them. */
  tell(): void {
    const { camera, canvas } = this.stage;
    const told = {
      tip: this.handle.tip().project(camera),
      phi1: this.knobs.seen("phi1"),
      phi2: this.knobs.seen("phi2"),
    };
    for (const [name, { x, y }] of Object.entries(told))
      canvas.dataset[name] = `${x.toFixed(4)},${y.toFixed(4)}`;
  }

  private place(): void {
    const at = position.value;
    if (!at) return;
    const part = drag.value === "part";
    const tip = part ? at.solution.part : at.solution.tool;
    if (tip) this.handle.place(sceneFrom(part ? "part" : "base"), new Vector3(tip.x, tip.y, tip.z));
    this.knobs.group.visible = part && at.solution.part !== undefined && !measuring.value;
    const geometry = machine.peek()?.definition.geometry;
    if (!at.solution.part || !geometry) return;
    const { x, y, z, phi1, phi2 } = at.solution.part;
    this.knobs.place(sceneFrom("part"), new Vector3(x, y, z), { phi1, phi2 }, unitOf(geometry));
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

function turned({ phi1, phi2 }: Angles): void {
  const part = position.peek()?.solution.part;
  if (part) moveTo({ by: "part", pose: { x: part.x, y: part.y, z: part.z, phi1, phi2 } });
}

function sceneFrom(frame: "base" | "part"): Matrix4 {
  return sceneFromFrame(frame, machine.peek()?.definition.table, position.peek()?.joints);
}
