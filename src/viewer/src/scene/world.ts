/** The whole scene: its parts follow the signals, each its own. */

import { effect } from "@preact/signals";
import { Group } from "three";
import { SCENE_FROM_BASE } from "../geometry/frames";
import { followed, ghosts, machine, pointed, position, tool } from "../state/store";
import { FacePointer } from "./face_pointer";
import { listenForGhosts } from "./ghost_pointer";
import { Ghosts } from "./ghosts";
import { LabelLayer } from "./label_layer";
import { MachineView } from "./machine_view";
import { Materials } from "./materials";
import { Measure } from "./measure";
import { followPalette } from "./palette";
import { picture } from "./picture";
import { samples } from "./samples";
import { Stage } from "./stage";
import { TipControl } from "./tip_control";
import { Viewpoint } from "./viewpoint";
import { WorkspaceView } from "./workspace_view";

export class World {
  readonly stage: Stage;
  readonly viewpoint: Viewpoint;

  constructor(
    canvas: HTMLCanvasElement,
    private readonly labels: HTMLElement,
    drawing: "software" | "hardware",
  ) {
    const stage = (this.stage = new Stage(canvas, drawing));
    const materials = new Materials();
    const machineView = new MachineView(stage, materials);
    const workspaceView = new WorkspaceView(stage, materials);
    const measure = new Measure(stage, materials);
    const tip = new TipControl(stage, materials);
    const otherPositions = new Ghosts(materials, stage);
    const names = new LabelLayer(stage, labels);

    // Everything in the base frame, mm.
    const base = new Group();
    base.matrixAutoUpdate = false;
    base.matrix.copy(SCENE_FROM_BASE);
    base.add(machineView.group, otherPositions.group, workspaceView.slice, measure.group);
    stage.scene.add(base, workspaceView.surface, tip.group);
    this.viewpoint = new Viewpoint(stage, [machineView.group, otherPositions.group]);

    stage.beforeDrawing.push(
      () => machineView.clear(),
      () => names.draw(),
      () => tip.tell(),
      () => workspaceView.hurry(),
    );
    followPalette((palette) => {
      materials.paint(palette);
      stage.scene.background = palette.background;
      stage.draw();
    });
    effect(() => {
      const { geometry } = machine.value?.definition ?? {};
      if (geometry) otherPositions.show(geometry, ghosts.value, position.value, tool.value, pointed.value);
      stage.draw();
    });
    stage.prepare(samples(materials));
    effect(() => {
      if (followed.value) stage.begin();
    });
    listenForGhosts(canvas, otherPositions);
    new FacePointer(stage, workspaceView);
  }

  /** The scene as it is seen, with its labels. */
  picture(): Promise<Blob> {
    return picture(this.stage, this.labels);
  }
}
