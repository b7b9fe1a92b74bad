/** A body of each kind that the first picture contains, in no scene. */

import { Group, Vector3 } from "three";
import type { Materials } from "./materials";
import { ball, box } from "./solids";
import { pieceMaterials } from "./workspace_mesh";

/** For `Stage.prepare`: the graphics processor translates the programs while answers are awaited. */
export function samples(materials: Materials): Group {
  const { frame, axisHead } = materials;
  const balls = [axisHead, ...pieceMaterials()].map((material) => ball(1, material));
  return new Group().add(box(new Vector3(), new Vector3(1, 1, 1), frame, materials), ...balls);
}
