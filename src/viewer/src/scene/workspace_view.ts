/** The workspace's surface and its slice: loaded, cut, and standing in the base frame or on the table. */

import { computed, effect } from "@preact/signals";
import { Group, Matrix4, type Raycaster } from "three";
import { inWords } from "../api/client";
import { AT_REST, baseFromTable, sceneFromPartGlb } from "../geometry/frames";
import { outdated } from "../state/computation";
import {
  isolated,
  keptLimit,
  machine,
  position,
  section,
  slice,
  slowDrawing,
  standIn,
  surfaces,
  wanted,
  workspace,
  workspaceNote,
} from "../state/store";
import type { Materials } from "./materials";
import { Section } from "./section";
import type { Stage } from "./stage";
import { WorkspaceMesh } from "./workspace_mesh";

export class WorkspaceView {
  private readonly mesh = new WorkspaceMesh();
  private readonly section: Section;

  constructor(
    private readonly stage: Stage,
    materials: Materials,
  ) {
    this.section = new Section(materials);
    const solid = computed(() => wanted.value.solid);
    effect(() => {
      const found = workspace.value;
      void this.mesh
        .show(found)
        .then((pieces) => {
          if (pieces) {
            surfaces.value = pieces.sort((a, b) => b.share - a.share);
            // A limit that bounds nothing any more cannot be isolated.
            if (!pieces.some(({ name }) => name === keptLimit.peek())) keptLimit.value = null;
          }
          this.stand();
        })
        .catch((thrown: unknown) => (workspaceNote.value = inWords(thrown)));
    });
    effect(() => void this.mesh.show(standIn.value, "coarse").catch(() => undefined));
    effect(() => {
      this.mesh.dress({ opaque: solid.value, outdated: outdated.value, isolated: isolated.value });
      if (isolated.value === null) delete stage.canvas.dataset["isolated"];
      else stage.canvas.dataset["isolated"] = isolated.value;
      stage.draw();
    });
    effect(() => {
      this.section.show(slice.value);
      stage.draw();
    });
    effect(() => this.cut());
    // The table carries the workspace on the part.
    position.subscribe(() => this.stand());
  }

  /** In the scene, metres. */
  get surface(): Group {
    return this.mesh.group;
  }

  /** In the base frame, mm. */
  get slice(): Group {
    return this.section.group;
  }

  /** The limit whose face is nearest along a ray. */
  under(ray: Raycaster): string | null {
    return this.mesh.under(ray);
  }

  /** Slow machines move a coarser workspace. */
  hurry(): void {
    const { slow, moving } = this.stage.resolution;
    if (slow) slowDrawing.value = true;
    this.mesh.quick(slow && moving);
  }

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
}
