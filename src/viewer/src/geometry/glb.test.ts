import { Mesh, type BufferGeometry, type MeshStandardMaterial } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { expect, test } from "vitest";
import { readGlb } from "./glb";

const VERTICES = 5;
const STRIDE = 24;

/** A file as the service writes them: two primitives whose vertices are interleaved in one view. */
function file(bits: 16 | 32): ArrayBuffer {
  const vertices = Float32Array.from({ length: 6 * VERTICES }, (_, i) => Math.fround(Math.sin(i)));
  const indices = [0, 1, 2, 1, 0, 2, 0, 1, 2];
  const packed = bits === 16 ? new Uint16Array(indices) : new Uint32Array(indices);
  const binary = new Uint8Array(Math.ceil((vertices.byteLength + packed.byteLength) / 4) * 4);
  binary.set(new Uint8Array(vertices.buffer));
  binary.set(new Uint8Array(packed.buffer), vertices.byteLength);
  const size = bits / 8;
  const vectors = (byteOffset: number, count: number) => ({
    ...{ bufferView: 0, byteOffset, count, componentType: 5126, type: "VEC3" },
    ...{ min: [-1, -1, -1], max: [1, 1, 1] },
  });
  const scalars = (first: number, count: number) => ({
    ...{ bufferView: 1, byteOffset: first * size, count, type: "SCALAR" },
    componentType: bits === 16 ? 5123 : 5125,
  });
  const document = {
    asset: { version: "2.0" },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0, name: "workspace", translation: [0.25, -1.5, 0.015625] }],
    meshes: [
      {
        primitives: [
          { attributes: { POSITION: 0, NORMAL: 1 }, indices: 2, material: 0, extras: { tag: 1 } },
          { attributes: { POSITION: 3, NORMAL: 4 }, indices: 5, material: 1, extras: { tag: 4 } },
        ],
        extras: { palette: [{ name: "stroke", rgb: [1, 2, 3] }] },
      },
    ],
    materials: [
      { pbrMetallicRoughness: { baseColorFactor: [0.1, 0.2, 0.3, 1] } },
      { pbrMetallicRoughness: {} },
    ],
    accessors: [
      ...[vectors(0, 3), vectors(12, 3), scalars(0, 6)],
      ...[vectors(2 * STRIDE, 3), vectors(2 * STRIDE + 12, 3), scalars(6, 3)],
    ],
    bufferViews: [
      { buffer: 0, byteLength: vertices.byteLength, byteStride: STRIDE },
      { buffer: 0, byteOffset: vertices.byteLength, byteLength: packed.byteLength },
    ],
    buffers: [{ byteLength: binary.byteLength }],
  };
  const text = new TextEncoder().encode(JSON.stringify(document));
  const json = new Uint8Array(Math.ceil(text.length / 4) * 4).fill(32);
  json.set(text);
  const whole = new Uint8Array(12 + 8 + json.length + 8 + binary.length);
  const head = new DataView(whole.buffer);
  [0x46546c67, 2, whole.length, json.length, 0x4e4f534a].forEach((word, i) =>
    head.setUint32(4 * i, word, true),
  );
  whole.set(json, 20);
  [binary.length, 0x4e4942].forEach((word, i) => head.setUint32(20 + json.length + 4 * i, word, true));
  whole.set(binary, 28 + json.length);
  return whole.buffer;
}

/** The numbers of an attribute, however they lie in memory. */
function numbers(geometry: BufferGeometry, name: string): number[][] {
  const attribute = geometry.getAttribute(name);
  return Array.from({ length: attribute.count }, (_, i) => [
    attribute.getX(i),
    attribute.getY(i),
    attribute.getZ(i),
  ]);
}

test.each([16, 32] as const)(
  "a surface with indices of %i bits is what three's own loader reads",
  async (bits) => {
    const found = readGlb(file(bits));
    const { scene } = await new GLTFLoader().parseAsync(file(bits), "");
    scene.updateMatrixWorld(true);
    const meshes: Mesh<BufferGeometry, MeshStandardMaterial>[] = [];
    scene.traverse((node) => {
      if (node instanceof Mesh) meshes.push(node as Mesh<BufferGeometry, MeshStandardMaterial>);
    });
    expect(found.pieces.map(({ tag }) => tag)).toEqual([1, 4]);
    expect(found.palette).toEqual([{ name: "stroke", rgb: [1, 2, 3] }]);
    expect(meshes).toHaveLength(2);
    meshes.forEach(({ geometry, material, matrixWorld }, i) => {
      const piece = found.pieces[i];
      if (!piece) throw new Error("a piece is missing");
      for (const name of ["position", "normal"])
        expect(numbers(piece.geometry, name)).toEqual(numbers(geometry, name));
      expect(Array.from(piece.geometry.index?.array ?? [])).toEqual(Array.from(geometry.index?.array ?? []));
      expect(piece.colour.toArray()).toEqual(material.color.toArray());
      expect(found.middle.toArray()).toEqual([12, 13, 14].map((entry) => matrixWorld.elements[entry]));
    });
  },
);

test("an empty surface has no pieces, and other bytes are refused", () => {
  const text = new TextEncoder().encode('{"asset":{"version":"2.0"},"scenes":[{}]}   ');
  const whole = new Uint8Array(20 + text.length);
  const head = new DataView(whole.buffer);
  [0x46546c67, 2, whole.length, text.length, 0x4e4f534a].forEach((word, i) =>
    head.setUint32(4 * i, word, true),
  );
  whole.set(text, 20);
  expect(readGlb(whole.buffer).pieces).toEqual([]);
  expect(() => readGlb(new TextEncoder().encode("solid workspace, which is no GLB").buffer)).toThrow(
    "no GLB",
  );
});
