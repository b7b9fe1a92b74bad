/** The surfaces in the service's GLB files. */

import { BufferAttribute, BufferGeometry, Color, Vector3 } from "three";

/** The triangles of one tag. */
export interface GlbPiece {
  /** Its entry of the palette. */
  tag: number;
  colour: Color;
  /** Metres from the middle, Y up. */
  geometry: BufferGeometry;
}

export interface GlbSurface {
  /** Where the middle stands, metres. */
  middle: Vector3;
  palette: { name: string; rgb: [number, number, number] }[];
  pieces: GlbPiece[];
}

/** What the service writes of glTF: one node with a mesh, triangles, 32-bit floats, and indices of 16 or 32 bits. */
interface Document {
  nodes?: { translation: [number, number, number] }[];
  meshes?: { primitives: Primitive[]; extras?: { palette?: GlbSurface["palette"] } }[];
  materials?: { pbrMetallicRoughness: { baseColorFactor: number[] } }[];
  accessors?: Accessor[];
  bufferViews?: { byteOffset?: number; byteStride?: number }[];
}

interface Primitive {
  attributes: { POSITION: number; NORMAL: number };
  indices: number;
  material: number;
  extras?: { tag?: number };
}

interface Accessor {
  bufferView: number;
  byteOffset?: number;
  count: number;
  componentType: number;
}

const MAGIC = 0x46546c67;
/** Bytes of the file's header, and of the header of a chunk. */
const HEADER = 12;
const CHUNK_HEADER = 8;
const UNSIGNED_SHORT = 5123;

/** Reads a file: glTF 2.0, sections 3.6 (accessors) and 4.4 (the container). */
export function readGlb(file: ArrayBuffer): GlbSurface {
  const head = new DataView(file);
  if (file.byteLength < HEADER + CHUNK_HEADER || head.getUint32(0, true) !== MAGIC)
    throw new Error("The service sent a surface that is no GLB file.");
  const length = head.getUint32(HEADER, true);
  const text = new Uint8Array(file, HEADER + CHUNK_HEADER, length);
  const document = JSON.parse(new TextDecoder().decode(text)) as Document;
  const data = new GlbData(document, new DataView(file, HEADER + CHUNK_HEADER + length));
  const [mesh] = document.meshes ?? [];
  return {
    middle: new Vector3(...(document.nodes?.[0]?.translation ?? [])),
    palette: mesh?.extras?.palette ?? [],
    pieces: (mesh?.primitives ?? []).map((primitive) => data.piece(primitive)),
  };
}

class GlbData {
  constructor(
    private readonly document: Document,
    /** The binary chunk with its header. */
    private readonly chunk: DataView,
  ) {}

  piece({ attributes, indices, material, extras }: Primitive): GlbPiece {
    const [red = 1, green = 1, blue = 1] =
      this.document.materials?.[material]?.pbrMetallicRoughness.baseColorFactor ?? [];
    const geometry = new BufferGeometry()
      .setAttribute("position", new BufferAttribute(this.vectors(attributes.POSITION), 3))
      .setAttribute("normal", new BufferAttribute(this.vectors(attributes.NORMAL), 3))
      .setIndex(new BufferAttribute(this.indices(indices), 1));
    return { tag: extras?.tag ?? 0, colour: new Color(red, green, blue), geometry };
  }

  private vectors(accessor: number): Float32Array {
    const { at, count, stride = 12 } = this.place(accessor);
    const vectors = new Float32Array(3 * count);
    for (let i = 0; i < vectors.length; i += 1)
      vectors[i] = this.chunk.getFloat32(at + stride * Math.floor(i / 3) + 4 * (i % 3), true);
    return vectors;
  }

  private indices(accessor: number): Uint16Array | Uint32Array {
    const { at, count, componentType } = this.place(accessor);
    if (componentType === UNSIGNED_SHORT)
      return Uint16Array.from({ length: count }, (_, i) => this.chunk.getUint16(at + 2 * i, true));
    return Uint32Array.from({ length: count }, (_, i) => this.chunk.getUint32(at + 4 * i, true));
  }

  /** Where an accessor's data begin in the chunk, and how they lie there. */
  private place(index: number): { at: number; count: number; componentType: number; stride?: number } {
    const accessor = this.document.accessors?.[index];
    const view = accessor && this.document.bufferViews?.[accessor.bufferView];
    if (!view) throw new Error("The service sent a surface that is incomplete.");
    const { count, componentType, byteOffset = 0 } = accessor;
    const at = CHUNK_HEADER + (view.byteOffset ?? 0) + byteOffset;
    return { at, count, componentType, ...(view.byteStride && { stride: view.byteStride }) };
  }
}
