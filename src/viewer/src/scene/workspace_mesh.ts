/** The workspace's surface, coloured by what limits each piece, and cut where a section is wanted. */

import {
  BackSide,
  Color,
  FrontSide,
  Group,
  Matrix4,
  Mesh,
  MeshLambertMaterial,
  Plane,
  Vector3,
  type BufferGeometry,
  type Raycaster,
} from "three";
import type { WorkspaceSummary } from "verne-client";
import { verne } from "../api/client";
import type { Surface } from "../state/store";
import { readGlb, type GlbPiece } from "../geometry/glb";
import { shares } from "../geometry/shares";

/** As it is, and coarser for machines that cannot move it so. */
type Grade = "fine" | "coarse";

/** A piece of the surface that one limit bounds, seen from one side. */
interface Piece {
  mesh: Mesh<BufferGeometry, MeshLambertMaterial>;
  colour: Color;
  /** The limit's name in the palette. */
  name: string;
}

export interface Look {
  opaque: boolean;
  /** Drawn without colours: it is not the workspace that is wanted. */
  outdated: boolean;
  /** The only limit whose pieces are seen well; null: all. */
  isolated: string | null;
}

/** The surface seen from within and from without, in the order in which they are drawn. */
const SIDES = [
  { side: BackSide, opacity: 0.22 },
  { side: FrontSide, opacity: 0.36 },
] as const;

/** Opacity of what is not isolated, and of what is. */
const FADED = 0.07;
const ISOLATED = 0.9;
const GREY = new Color(0x8a8f96);

/** The materials of a piece's sides, transparent as they are at first. */
export function pieceMaterials(): MeshLambertMaterial[] {
  return SIDES.map(({ side }) => new MeshLambertMaterial({ side, transparent: true }));
}

export class WorkspaceMesh {
  readonly group = new Group();
  private readonly grades = { fine: new Group(), coarse: new Group() };
  private readonly pieces: Record<Grade, Piece[]> = { fine: [], coarse: [] };
  private readonly shown: Record<Grade, string | null> = { fine: null, coarse: null };
  private look: Look = { opaque: false, outdated: false, isolated: null };
  private readonly plane = new Plane();
  /** In the GLB's own frame, metres: what lies below it is shown. */
  private height: number | null = null;

  constructor() {
    this.group.matrixAutoUpdate = false;
    this.group.add(this.grades.fine, this.grades.coarse);
    this.quick(false);
  }

  dress(look: Look): void {
    this.look = look;
    this.paint();
  }

  /** Loads and shows; answers the pieces of the surface, or null if something newer came between. */
  async show(summary: WorkspaceSummary | null, grade: Grade = "fine"): Promise<Surface[] | null> {
    this.shown[grade] = summary?.id ?? null;
    if (!summary || summary.triangles === 0) {
      this.clear(grade);
      return [];
    }
    const { middle, palette, pieces } = readGlb(await verne.mesh(summary.id));
    if (this.shown[grade] !== summary.id) return null;
    this.clear(grade);
    for (const piece of pieces) this.add(grade, piece, middle, palette[piece.tag]?.name ?? "");
    this.paint();
    return shares(pieces, palette);
  }

  /** The limit whose piece is nearest along a ray; null where there is none. */
  under(ray: Raycaster): string | null {
    const meshes = this.pieces.fine.map(({ mesh }) => mesh);
    const seen = ray
      .intersectObjects(meshes, false)
      .find(({ point }) => this.height === null || this.plane.distanceToPoint(point) >= 0);
    return this.pieces.fine.find(({ mesh }) => mesh === seen?.object)?.name ?? null;
  }

  /** The coarser one, where there is one, while the hand moves. */
  quick(quick: boolean): void {
    const { fine, coarse } = this.grades;
    coarse.visible = quick && coarse.children.length > 0;
    fine.visible = !coarse.visible;
  }

  /** Where the GLB's frame stands in the scene. */
  stand(sceneFromGlb: Matrix4): void {
    this.group.matrix.copy(sceneFromGlb);
    this.group.matrixWorldNeedsUpdate = true;
    this.turnPlane();
  }

  /** Cuts at a height of the GLB's frame, metres, and shows what lies below; null: whole. */
  cut(height: number | null): void {
    this.height = height;
    this.paint();
    this.turnPlane();
  }

  private add(grade: Grade, { geometry, colour }: GlbPiece, middle: Vector3, name: string): void {
    for (const [order, material] of pieceMaterials().entries()) {
      const mesh = new Mesh(geometry, material);
      mesh.position.copy(middle);
      mesh.renderOrder = 10 + order;
      this.grades[grade].add(mesh);
      this.pieces[grade].push({ mesh, colour, name });
    }
  }

  /** Gives every piece the colour, the transparency and the section that are wanted. */
  private paint(): void {
    const { opaque, outdated, isolated } = this.look;
    for (const { mesh, colour, name } of [...this.pieces.fine, ...this.pieces.coarse]) {
      const { material } = mesh;
      const usual = SIDES.find(({ side }) => side === material.side)?.opacity ?? 1;
      const plain = opaque ? 1 : usual;
      const opacity = isolated === null ? plain : name === isolated ? ISOLATED : FADED;
      material.color.copy(colour);
      if (outdated) material.color.lerp(GREY, 0.85);
      material.opacity = outdated ? Math.min(opacity, usual) * 0.6 : opacity;
      material.transparent = material.opacity < 1;
      material.depthWrite = !material.transparent;
      material.clippingPlanes = this.height === null ? [] : [this.plane];
      material.needsUpdate = true;
    }
  }

  private turnPlane(): void {
    if (this.height === null) return;
    this.plane.setFromNormalAndCoplanarPoint(new Vector3(0, -1, 0), new Vector3(0, this.height, 0));
    this.plane.applyMatrix4(this.group.matrix);
  }

  private clear(grade: Grade): void {
    for (const { mesh } of this.pieces[grade]) {
      mesh.geometry.dispose();
      mesh.material.dispose();
    }
    this.pieces[grade] = [];
    this.grades[grade].clear();
  }
}
