/** The whole scene: follows the signals, and tells where the hand drags the tool. */

import { computed, effect } from "@preact/signals";
import { Group, Matrix4, Vector2, Vector3 } from "three";
import { CSS2DRenderer } from "three/addons/renderers/CSS2DRenderer.js";
import { baseFromTable, SCENE_FROM_BASE, sceneFromPartGlb, type TableAngles } from "../geometry/frames";
import {
  camera,
  change,
  complaint,
  drag,
  ghosts,
  machine,
  pointed,
  position,
  section,
  slice,
  slowDrawing,
  standIn,
  surfaces,
  tool,
  wanted,
  workspace,
  workspaceNote,
  type InUse,
} from "../state/store";
import { moveTo, pick } from "../state/motion";
import { bars } from "../words/margins";
import { inWords } from "../api/client";
import { Ghosts } from "./ghosts";
import { Handle } from "./handle";
import { Materials } from "./materials";
import { Mechanism, unitOf } from "./mechanism";
import { followPalette, type Palette } from "./palette";
import { Section } from "./section";
import { Stage } from "./stage";
import { Surroundings } from "./surroundings";
import { label, Triad } from "./triads";
import { WorkspaceMesh } from "./workspace_mesh";

/** A margin of less than this part of its range is shown on the machine. */
const NEAR = 0.05;
const AT_REST: TableAngles = { theta1: 0, theta2: 0 };

export type Side = "whole" | "front" | "side" | "top";
const FROM: Record<Side, Vector3> = {
  whole: new Vector3(0.5, 0.36, 1),
  front: new Vector3(0, 0.02, 1),
  side: new Vector3(1, 0.02, 0),
  top: new Vector3(0, 1, 0.001),
};

export class World {
  readonly stage: Stage;
  private readonly materials = new Materials();
  /** Everything in the base frame, mm. */
  private readonly base = new Group();
  private readonly fixed = new Group();
  private readonly ghosts: Ghosts;
  private readonly mesh = new WorkspaceMesh();
  private readonly section = new Section(this.materials);
  private readonly handle: Handle;
  private readonly labels: CSS2DRenderer;
  private readonly baseTriad = new Triad(["x", "y", "z down"], [260, 260, 260]);
  private readonly partTriad = new Triad(["X", "Y", "Z up"], [390, 390, 220]);
  private mechanism: Mechanism | null = null;
  private surroundings: Surroundings | null = null;

  constructor(canvas: HTMLCanvasElement, labels: HTMLElement, drawing: "software" | "hardware") {
    this.stage = new Stage(canvas, drawing);
    this.labels = new CSS2DRenderer({ element: labels });
    this.ghosts = new Ghosts(this.materials, this.stage);
    this.handle = new Handle(
      this.stage,
      this.materials,
      (tip) => this.dragged(tip),
      () => this.placeHandle(),
    );
    this.base.matrixAutoUpdate = false;
    this.base.matrix.copy(SCENE_FROM_BASE);
    this.base.add(
      this.fixed,
      this.ghosts.group,
      this.section.group,
      this.baseTriad.group,
      this.partTriad.group,
    );
    this.partTriad.group.matrixAutoUpdate = false;
    this.stage.scene.add(this.base, this.mesh.group, this.handle.group);
    this.stage.beforeDrawing.push(
      () => this.drawLabels(),
      () => this.hurry(),
    );
    this.stage.controls.addEventListener("end", () => change({ camera: rounded(this.stage.seen()) }));
    followPalette((palette) => this.paint(palette));
    this.follow();
    this.listen(canvas);
  }

  /** Looks at the machine from a side, all of it. */
  lookFrom(side: Side): void {
    const { surroundings, mechanism } = this;
    if (!surroundings || !mechanism) return;
    const [top, floor] = [surroundings.top, surroundings.floor].map((z) => -z / 1000) as [number, number];
    const unit = (floor - top) * -0.5;
    this.stage.frame(new Vector3(0, (top + floor) / 2, 0), unit * 1.13, FROM[side]);
    change({ camera: null });
  }

  private follow(): void {
    const solid = computed(() => wanted.value.solid);
    effect(() => this.build(machine.value));
    effect(() => this.move());
    effect(() => {
      const { geometry } = machine.value?.definition ?? {};
      if (geometry) this.ghosts.show(geometry, ghosts.value, position.value, tool.value, pointed.value);
      this.stage.draw();
    });
    effect(() => {
      const found = workspace.value;
      void this.mesh
        .show(found)
        .then((pieces) => {
          if (pieces) surfaces.value = pieces.sort((a, b) => b.share - a.share);
          this.stand();
        })
        .catch((thrown: unknown) => (workspaceNote.value = inWords(thrown)));
    });
    effect(() => void this.mesh.show(standIn.value, "coarse").catch(() => undefined));
    effect(() => {
      this.mesh.solid(solid.value);
      this.stage.draw();
    });
    effect(() => {
      this.section.show(slice.value);
      this.stage.draw();
    });
    effect(() => this.cut());
    effect(() => {
      const seen = camera.value;
      if (seen) this.stage.look(seen);
    });
  }

  private build(found: InUse | null): void {
    this.fixed.clear();
    if (!found) return;
    const { definition } = found;
    this.mechanism = new Mechanism(definition.geometry, this.materials);
    this.surroundings = new Surroundings(definition, this.materials);
    const unit = unitOf(definition.geometry);
    this.baseTriad.group.scale.setScalar(unit);
    this.partTriad.group.scale.setScalar(unit);
    this.fixed.add(this.mechanism.group, this.surroundings.group, ...sliderLabels(found));
    if (!camera.peek()) this.lookFrom("whole");
  }

  /** Machine, table, handle and marker where they are now. */
  private move(): void {
    const at = position.value;
    const found = machine.value;
    if (!at || !found || !this.mechanism || !this.surroundings) return;
    const { rho } = at.joints;
    this.mechanism.place(rho, at.solution.platform, tool.value);
    const worst = bars(at.solution.margins, found.definition, found.home)[0];
    const near = worst && worst.part < NEAR ? worst : null;
    this.mechanism.mark(near, near && near.part < 0 ? this.materials.bad : this.materials.warn);
    this.surroundings.turn(at.joints);
    this.partTriad.group.matrix.copy(baseFromTable(found.definition.table, at.joints));
    this.partTriad.group.matrixWorldNeedsUpdate = true;
    this.placeHandle();
    this.mark();
    this.stand();
  }

  private placeHandle(): void {
    const at = position.value;
    if (!at) return;
    const part = drag.value === "part";
    const tip = part ? at.solution.part : at.solution.tool;
    if (tip) this.handle.place(this.sceneFrom(part ? "part" : "base"), new Vector3(tip.x, tip.y, tip.z));
  }

  private mark(): void {
    const missed = complaint.value?.wanted;
    const point = missed
      ? new Vector3(missed.x, missed.y, missed.z).applyMatrix4(this.sceneFrom(missed.frame))
      : null;
    this.handle.mark(point);
  }

  private dragged(tip: Vector3): void {
    const [x, y, z] = tip.toArray();
    const part = position.peek()?.solution.part;
    if (drag.peek() === "part" && part) {
      moveTo({ by: "part", pose: { x, y, z, phi1: part.phi1, phi2: part.phi2 } });
    } else {
      moveTo({ by: "tool", pose: { x, y, z } });
    }
  }

  private sceneFrom(frame: "base" | "part"): Matrix4 {
    const definition = machine.peek()?.definition;
    if (frame === "base" || !definition) return SCENE_FROM_BASE.clone();
    return SCENE_FROM_BASE.clone().multiply(
      baseFromTable(definition.table, position.peek()?.joints ?? AT_REST),
    );
  }

  /** The workspace stands in the base frame, or on the table. */
  private stand(): void {
    const found = workspace.peek();
    const definition = machine.peek()?.definition;
    if (found && definition) {
      const angles = position.peek()?.joints ?? AT_REST;
      const part = found.frame === "part";
      this.mesh.stand(part ? sceneFromPartGlb(definition.table, angles) : new Matrix4());
      this.section.group.matrix.copy(part ? baseFromTable(definition.table, angles) : new Matrix4());
      this.section.group.matrixWorldNeedsUpdate = true;
    }
    this.stage.draw();
  }

  private cut(): void {
    const found = workspace.value;
    const at = section.value;
    const up = found?.frame === "part" ? 1e-3 : -1e-3;
    this.mesh.cut(found && at !== null ? at * up : null);
    this.stage.draw();
  }

  private paint(palette: Palette): void {
    this.materials.paint(palette);
    this.stage.scene.background = palette.background;
    for (const triad of [this.baseTriad, this.partTriad]) triad.paint(palette);
    this.stage.draw();
  }

  /** Slow machines move a coarser workspace. */
  private hurry(): void {
    const { slow, moving } = this.stage.resolution;
    if (slow) slowDrawing.value = true;
    this.mesh.quick(slow && moving);
  }

  private drawLabels(): void {
    const { clientWidth, clientHeight } = this.stage.canvas;
    const size = this.labels.getSize();
    if (size.width !== clientWidth || size.height !== clientHeight)
      this.labels.setSize(clientWidth, clientHeight);
    this.labels.render(this.stage.scene, this.stage.camera);
    // Where the tip is seen, -1 to 1 both ways: for tests that drag it.
    const [u, v] = this.handle.tip().project(this.stage.camera).toArray();
    this.stage.canvas.dataset["tip"] = `${u.toFixed(4)},${v.toFixed(4)}`;
  }

  /** Ghosts are pointed at and picked by hand too. */
  private listen(canvas: HTMLCanvasElement): void {
    let pressed = new Vector2();
    const at = (event: PointerEvent) => {
      const { left, top, width, height } = canvas.getBoundingClientRect();
      return new Vector2(((event.clientX - left) / width) * 2 - 1, 1 - ((event.clientY - top) / height) * 2);
    };
    canvas.addEventListener("pointerdown", (event) => (pressed = new Vector2(event.clientX, event.clientY)));
    canvas.addEventListener("pointermove", (event) => {
      if (event.buttons === 0 && ghosts.peek().length > 0) pointed.value = this.ghosts.under(at(event));
    });
    canvas.addEventListener("pointerup", (event) => {
      if (pressed.distanceTo(new Vector2(event.clientX, event.clientY)) > 4) return;
      const ghost = ghosts.peek()[this.ghosts.under(at(event)) ?? -1];
      if (ghost) pick(ghost);
    });
  }
}

function sliderLabels({ definition }: InUse) {
  const { geometry: g, limits } = definition;
  const places: [number, number][] = [
    [g.d1, 0],
    [g.d2, -g.r4],
    [g.d2, g.r4],
  ];
  return places.map(([x, y], i) => {
    const text = label(`slider ${i + 1}`, "slider");
    text.position.set(x, y, (limits.stroke[i]?.[0] ?? 0) - 110 * unitOf(g));
    return text;
  });
}

function rounded(camera: { eye: [number, number, number]; target: [number, number, number] }) {
  const round = (point: [number, number, number]) =>
    point.map((value) => Math.round(value * 1000) / 1000) as [number, number, number];
  return { eye: round(camera.eye), target: round(camera.target) };
}
