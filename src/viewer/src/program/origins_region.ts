/** The region of origins in the scene: a surface that is seen through, and a mark at the present origin. */

import { effect } from "@preact/signals";
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DoubleSide,
  Group,
  Mesh,
  MeshLambertMaterial,
  Points,
  PointsMaterial,
} from "three";
import type { OriginsSummary } from "verne-client";
import { inWords, verne } from "../api/client";
import { baseFromTable, SCENE_FROM_BASE, sceneFromPartGlb } from "../geometry/frames";
import { readGlb } from "../geometry/glb";
import { followPalette } from "../scene/palette";
import type { Stage } from "../scene/stage";
import { label } from "../scene/triads";
import { machine, position } from "../state/store";
import { origins, regionOutdated } from "./origins";
import { settings } from "./program_state";
import { roundPoint } from "./round_point";

const OPACITY = 0.3;
const GREY = new Color(0x8a8f96);

export class OriginsRegion {
  /** In the frame of GLB files of the table, metres. */
  private readonly surface = new Group();
  /** In the part frame, mm. */
  private readonly mark = new Group();
  private readonly at = new Group();
  private readonly material = new MeshLambertMaterial({
    side: DoubleSide,
    transparent: true,
    opacity: OPACITY,
    depthWrite: false,
  });
  private readonly point = new PointsMaterial({
    size: 13,
    sizeAttenuation: false,
    depthTest: false,
    transparent: true,
    map: roundPoint(),
  });
  private accent = new Color();
  /** The region that is wanted. */
  private wanted: string | null = null;

  constructor(private readonly stage: Stage) {
    for (const group of [this.surface, this.mark]) group.matrixAutoUpdate = false;
    const origin = new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(3), 3));
    const point = new Points(origin, this.point);
    point.renderOrder = 27;
    this.at.add(point, label("origin of the set-up"));
    this.mark.add(this.at);
    stage.scene.add(this.surface, this.mark);
    followPalette(({ accent, ink }) => {
      this.accent = accent;
      this.point.color = ink;
      this.paint(regionOutdated.peek());
    });
    effect(() => this.paint(regionOutdated.value));
    effect(() => {
      const found = origins.found.value;
      void this.show(found?.answer ?? null).catch((thrown: unknown) => {
        origins.trouble.value = inWords(thrown);
      });
    });
    effect(() => {
      const { x, y, z } = settings.value.setup;
      this.at.position.set(x, y, z);
      stage.draw();
    });
    effect(() => {
      const [stands, table] = [position.value, machine.value?.definition.table];
      if (!stands || !table) return;
      this.surface.matrix.copy(sceneFromPartGlb(table, stands.joints));
      this.mark.matrix.copy(SCENE_FROM_BASE).multiply(baseFromTable(table, stands.joints));
      for (const group of [this.surface, this.mark]) group.matrixWorldNeedsUpdate = true;
      stage.draw();
    });
  }

  /** Loads the surface; something newer that comes between is shown instead. */
  private async show(region: OriginsSummary | null): Promise<void> {
    this.wanted = region?.id ?? null;
    this.mark.visible = region !== null;
    this.clear();
    if (region && region.triangles > 0) {
      const { middle, pieces } = readGlb(await verne.file(`${region.links.mesh}.glb`));
      if (this.wanted !== region.id) return;
      this.clear();
      for (const { geometry } of pieces) {
        const piece = new Mesh(geometry, this.material);
        piece.position.copy(middle);
        piece.renderOrder = 12;
        this.surface.add(piece);
      }
      this.stage.canvas.dataset["origins"] = region.id;
    }
    this.stage.draw();
  }

  private paint(outdated: boolean): void {
    this.material.color.copy(outdated ? GREY : this.accent);
    this.material.opacity = outdated ? OPACITY / 2 : OPACITY;
    this.stage.draw();
  }

  private clear(): void {
    this.surface.traverse((node) => {
      if (node instanceof Mesh) (node.geometry as BufferGeometry).dispose();
    });
    this.surface.clear();
    delete this.stage.canvas.dataset["origins"];
  }
}
