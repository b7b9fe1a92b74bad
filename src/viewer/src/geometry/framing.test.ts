import { expect, test } from "vitest";
import { OrthographicCamera, PerspectiveCamera, Vector3 } from "three";
import { framing } from "./framing";

const POINTS = [
  [-0.7, -1.9, -0.6],
  [0.7, 0.1, 0.6],
  [0.2, -1, 2],
  [-3, -1, 0.1],
].map(([x, y, z]) => new Vector3(x, y, z));

test("all points are in the picture, and they fill it", () => {
  for (const aspect of [0.5, 1, 2.2]) {
    for (const from of [new Vector3(0.5, 0.36, 1), new Vector3(-1, 0, 0), new Vector3(0, 1, 0.001)]) {
      for (const parallel of [false, true]) {
        const half = Math.PI / 11;
        const { eye, target, height } = framing(POINTS, from, parallel ? null : half, aspect);
        const tall = (height ?? 1) / 2;
        const camera = parallel
          ? new OrthographicCamera(-tall * aspect, tall * aspect, tall, -tall, 0.01, 100)
          : new PerspectiveCamera((2 * half * 180) / Math.PI, aspect, 0.01, 100);
        camera.position.set(...eye);
        camera.lookAt(...target);
        camera.updateMatrixWorld();
        camera.updateProjectionMatrix();
        const edge = Math.max(
          ...POINTS.map((point) => {
            const { x, y } = point.clone().project(camera);
            return Math.max(Math.abs(x), Math.abs(y));
          }),
        );
        expect(edge).toBeLessThan(1);
        expect(edge).toBeGreaterThan(0.8);
      }
    }
  }
});
