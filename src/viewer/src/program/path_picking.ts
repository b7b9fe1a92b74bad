/** Clicks on the path. */

import { Points, Raycaster, Vector2, type Group, type Intersection, type Object3D } from "three";
import type { Stage } from "../scene/stage";
import { goToFailure } from "./failures";
import { seekRow } from "./player";
import { plan } from "./program_state";

/** Pixels from the path within which a click finds it. */
const NEAR = 6;
/** Pixels that the hand may move between pressing and releasing. */
const STILL = 4;

export interface Lines {
  readonly group: Group;
  /** The row to which each segment of a line leads. */
  readonly rows: ReadonlyMap<Object3D, Uint32Array>;
}

/** A click on the path, not the end of a turn of the camera, moves the machine there. */
export function listenForClicks(stage: Stage, lines: Lines): void {
  const { canvas } = stage;
  let pressed = new Vector2();
  canvas.addEventListener("pointerdown", (event) => (pressed = new Vector2(event.clientX, event.clientY)));
  canvas.addEventListener("pointerup", (event) => {
    const still = pressed.distanceTo(new Vector2(event.clientX, event.clientY)) <= STILL;
    if (still && stage.controls.enabled) pick(stage, lines, event);
  });
}

function pick({ canvas, camera, pixel }: Stage, { group, rows }: Lines, event: PointerEvent): void {
  if (rows.size === 0) return;
  const { left, top, width, height } = canvas.getBoundingClientRect();
  const u = ((event.clientX - left) / width) * 2 - 1;
  const v = 1 - ((event.clientY - top) / height) * 2;
  const raycaster = new Raycaster();
  raycaster.setFromCamera(new Vector2(u, v), camera);
  raycaster.params.Line.threshold = NEAR * pixel;
  raycaster.params.Points.threshold = 1.5 * NEAR * pixel;
  const pickable = [...rows.keys()];
  group.traverse((object) => {
    if (object instanceof Points) pickable.push(object);
  });
  const hits = raycaster.intersectObjects(pickable, false);
  const off = ({ point }: Intersection) => raycaster.ray.distanceToPoint(point);
  hits.sort((a, b) => off(a) - off(b));
  const mark = hits.find(({ object }) => object instanceof Points);
  const failure = plan.peek()?.report.failures[mark?.index ?? -1];
  if (failure) {
    goToFailure(failure);
    return;
  }
  const line = hits.find(({ object }) => rows.has(object));
  const row = line && rows.get(line.object)?.[Math.floor((line.index ?? 0) / 2)];
  if (row !== undefined) seekRow(row);
}
