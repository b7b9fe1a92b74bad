/** How much of a surface each of its pieces is. */

import { Triangle, Vector3, type BufferGeometry } from "three";

interface Named {
  name: string;
  rgb: [number, number, number];
}

/** The palette's entries with their part of the area, by the tags of the triangles' first corners. */
export function shares<T extends Named>(geometry: BufferGeometry, palette: T[]): (T & { share: number })[] {
  const areas = palette.map(() => 0);
  const { index } = geometry;
  const position = geometry.getAttribute("position");
  const tags = geometry.getAttribute("_tag");
  if (index && tags) {
    const [a, b, c] = [new Vector3(), new Vector3(), new Vector3()];
    const triangle = new Triangle(a, b, c);
    for (let i = 0; i < index.count; i += 3) {
      a.fromBufferAttribute(position, index.getX(i));
      b.fromBufferAttribute(position, index.getX(i + 1));
      c.fromBufferAttribute(position, index.getX(i + 2));
      const tag = tags.getX(index.getX(i));
      areas[tag] = (areas[tag] ?? 0) + triangle.getArea();
    }
  }
  const whole = areas.reduce((sum, area) => sum + area, 0) || 1;
  return palette.map((entry, i) => ({ ...entry, share: (areas[i] ?? 0) / whole }));
}
