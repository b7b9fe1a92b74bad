/** The layers of a dexterity map in the scene: a square for each point, on the table. */

import { effect, type ReadonlySignal } from "@preact/signals";
import { BufferAttribute, BufferGeometry, Color, DoubleSide, Mesh, MeshBasicMaterial } from "three";
import { AT_REST, sceneFromFrame } from "../geometry/frames";
import type { Stage } from "../scene/stage";
import { machine, position } from "../state/store";
import { allLayers, map, visible } from "./dexterity_state";
import { CLASSES, type Layer } from "./reached_share";

/** Side of a square, as a part of the distance between points: of one layer, and where layers lie over each other. */
const SIDE = { one: 0.94, all: 0.45 };
const OPACITY = { one: 0.9, all: 0.5 };
const COLOURS = CLASSES.map(({ colour }) => new Color(colour));
/** Two triangles of a square's corners. */
const TRIANGLES = [0, 1, 2, 0, 2, 3] as const;
const CORNERS = [
  [-1, -1],
  [1, -1],
  [1, 1],
  [-1, 1],
] as const;

/** Keeps the layers in the scene that the panel has chosen. */
export function keepLayersIn(stage: ReadonlySignal<Stage | null>): void {
  const material = new MeshBasicMaterial({ vertexColors: true, side: DoubleSide, transparent: true });
  const mesh = new Mesh(new BufferGeometry(), material);
  mesh.matrixAutoUpdate = false;
  effect(() => void stage.value?.scene.add(mesh));
  effect(() => {
    const scene = stage.value;
    const grid = map.value?.summary.grid;
    const how = allLayers.value ? "all" : "one";
    mesh.geometry.dispose();
    mesh.geometry = squares(visible.value, (grid?.step ?? 0) * SIDE[how], grid?.turn ?? 0);
    mesh.visible = visible.value.length > 0;
    material.opacity = OPACITY[how];
    if (!scene) return;
    scene.canvas.dataset["layers"] = visible.value.map(({ z }) => z).join(" ");
    scene.draw();
  });
  // The table carries the map.
  effect(() => {
    const angles = position.value?.joints ?? AT_REST;
    mesh.matrix.copy(sceneFromFrame("part", machine.value?.definition.table, angles));
    mesh.matrixWorldNeedsUpdate = true;
    stage.value?.draw();
  });
}

function squares(layers: readonly Layer[], side: number, turnDegrees: number): BufferGeometry {
  const count = layers.reduce((sum, { points }) => sum + points.length, 0);
  const positions = new Float32Array(count * TRIANGLES.length * 3);
  const colours = new Float32Array(count * TRIANGLES.length * 3);
  const turn = (turnDegrees * Math.PI) / 180;
  const [cos, sin] = [(Math.cos(turn) * side) / 2, (Math.sin(turn) * side) / 2];
  const corners = TRIANGLES.map((corner) => {
    const [u, v] = CORNERS[corner];
    return [cos * u - sin * v, sin * u + cos * v] as const;
  });
  let at = 0;
  for (const { z, points } of layers)
    for (const { x, y, group } of points)
      for (const [dx, dy] of corners) {
        positions.set([x + dx, y + dy, z], at);
        COLOURS[group]?.toArray(colours, at);
        at += 3;
      }
  return new BufferGeometry()
    .setAttribute("position", new BufferAttribute(positions, 3))
    .setAttribute("color", new BufferAttribute(colours, 3));
}
