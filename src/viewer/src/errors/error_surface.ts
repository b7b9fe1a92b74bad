/** The surface of the workspace in the scene, in the bands of an error. */

import { effect, type ReadonlySignal } from "@preact/signals";
import { DoubleSide, Group, Matrix4, Mesh, MeshLambertMaterial, type BufferGeometry } from "three";
import { AT_REST, sceneFromPartGlb } from "../geometry/frames";
import type { Stage } from "../scene/stage";
import { machine, position } from "../state/store";
import { map, shown, surface } from "./errors_state";

const OPACITY = 0.8;

/** Keeps the surface in the scene that the panel has chosen. */
export function keepSurfaceIn(stage: ReadonlySignal<Stage | null>): void {
  const group = new Group();
  group.matrixAutoUpdate = false;
  effect(() => void stage.value?.scene.add(group));
  effect(() => {
    const scene = stage.value;
    const found = shown.value ? surface.value : null;
    clear(group);
    for (const { colour, geometry } of found?.pieces ?? []) {
      const material = new MeshLambertMaterial({
        color: colour,
        side: DoubleSide,
        transparent: true,
        opacity: OPACITY,
      });
      const piece = new Mesh(geometry, material);
      if (found) piece.position.copy(found.middle);
      piece.renderOrder = 11;
      group.add(piece);
    }
    if (!scene) return;
    scene.canvas.dataset["bands"] = String(group.children.length);
    scene.draw();
  });
  // The table carries what is on the part.
  effect(() => {
    const table = machine.value?.definition.table;
    const angles = position.value?.joints ?? AT_REST;
    const onPart = map.value?.frame === "part";
    group.matrix.copy(onPart && table ? sceneFromPartGlb(table, angles) : new Matrix4());
    group.matrixWorldNeedsUpdate = true;
    stage.value?.draw();
  });
}

/** Frees what the graphics processor holds; a surface that is shown again is sent anew. */
function clear(group: Group): void {
  for (const piece of group.children) {
    if (!(piece instanceof Mesh)) continue;
    (piece.geometry as BufferGeometry).dispose();
    (piece.material as MeshLambertMaterial).dispose();
  }
  group.clear();
}
