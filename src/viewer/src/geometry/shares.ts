/** How much of a surface each of its pieces is. */

import { Triangle, Vector3 } from "three";
import type { GlbPiece } from "./glb";

interface Named {
  name: string;
  rgb: [number, number, number];
}

/** The palette's entries with their part of the area; a piece is of the entry that its tag numbers. */
export function shares<T extends Named>(
  pieces: Pick<GlbPiece, "tag" | "geometry">[],
  palette: T[],
): (T & { share: number })[] {
  const areas = palette.map(() => 0);
  const [a, b, c] = [new Vector3(), new Vector3(), new Vector3()];
  const triangle = new Triangle(a, b, c);
  for (const { tag, geometry } of pieces) {
    const { index } = geometry;
    const position = geometry.attributes["position"];
    if (!index || !position) continue;
    for (let i = 0; i < index.count; i += 3) {
      a.fromBufferAttribute(position, index.getX(i));
      b.fromBufferAttribute(position, index.getX(i + 1));
      c.fromBufferAttribute(position, index.getX(i + 2));
      areas[tag] = (areas[tag] ?? 0) + triangle.getArea();
    }
  }
  const whole = areas.reduce((sum, area) => sum + area, 0) || 1;
  return palette.map((entry, i) => ({ ...entry, share: (areas[i] ?? 0) / whole }));
}
