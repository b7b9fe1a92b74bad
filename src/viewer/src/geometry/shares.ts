/** How much of a surface each of its pieces is. */

import { Triangle, Vector3, type BufferGeometry } from "three";

interface Named {
  name: string;
  rgb: [number, number, number];
}

/** The palette's entries with their part of the area; a geometry is of the entry that its `tag` numbers. */
export function shares<T extends Named>(
  geometries: BufferGeometry[],
  palette: T[],
): (T & { share: number })[] {
  const areas = palette.map(() => 0);
  const [a, b, c] = [new Vector3(), new Vector3(), new Vector3()];
  const triangle = new Triangle(a, b, c);
  for (const { index, attributes, userData } of geometries) {
    const position = attributes["position"];
    const tag = userData["tag"] as number;
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
