/** The workspace's surface, coloured by what limits each piece, and cut where a section is wanted. */

import {
  BackSide,
  FrontSide,
  Group,
  Matrix4,
  Mesh,
  MeshLambertMaterial,
  Plane,
  Vector3,
  type BufferGeometry,
  type MeshStandardMaterial,
} from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import type { WorkspaceSummary } from "verne-client";
import { verne } from "../api/client";
import type { Surface } from "../state/store";
import { shares } from "../geometry/shares";

/** As it is, and coarser for machines that cannot move it so. */
type Grade = "fine" | "coarse";

type Piece = Mesh<BufferGeometry, MeshLambertMaterial>;

/** The surface seen from within and from without, in the order in which they are drawn. */
const SIDES = [
  { side: BackSide, opacity: 0.22 },
  { side: FrontSide, opacity: 0.36 },
] as const;

export class WorkspaceMesh {
  readonly group = new Group();
  private readonly grades = { fine: new Group(), coarse: new Group() };
  private readonly pieces: Record<Grade, Piece[]> = { fine: [], coarse: [] };
  private readonly shown: Record<Grade, string | null> = { fine: null, coarse: null };
  private readonly loader = new GLTFLoader();
  private opaque = false;
  private readonly plane = new Plane();
  /** In the GLB's own frame, metres: what lies below it is shown. */
  private height: number | null = null;

  constructor() {
    this.group.matrixAutoUpdate = false;
    this.group.add(this.grades.fine, this.grades.coarse);
    this.quick(false);
  }

  solid(solid: boolean): void {
    this.opaque = solid;
    this.paint();
  }

  /** Loads and shows; answers the pieces of the surface, or null if something newer came between. */
  async show(summary: WorkspaceSummary | null, grade: Grade = "fine"): Promise<Surface[] | null> {
    this.shown[grade] = summary?.id ?? null;
    if (!summary || summary.triangles === 0) {
      this.clear(grade);
      return [];
    }
    const loaded = await this.loader.parseAsync(await verne.mesh(summary.id), "");
    if (this.shown[grade] !== summary.id) return null;
    this.clear(grade);
    loaded.scene.updateMatrixWorld(true);
    const pieces: Mesh<BufferGeometry, MeshStandardMaterial>[] = [];
    loaded.scene.traverse((node) => {
      if (node instanceof Mesh) pieces.push(node as Mesh<BufferGeometry, MeshStandardMaterial>);
    });
    for (const piece of pieces) {
      for (const [order, { side }] of SIDES.entries()) {
        const shown = new Mesh(
          piece.geometry,
          new MeshLambertMaterial({ color: piece.material.color, side }),
        );
        piece.getWorldPosition(shown.position);
        shown.renderOrder = 10 + order;
        this.grades[grade].add(shown);
        this.pieces[grade].push(shown);
      }
    }
    this.paint();
    const palette = (pieces[0]?.userData["palette"] ?? []) as Omit<Surface, "share">[];
    return shares(
      pieces.map((piece) => piece.geometry),
      palette,
    );
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

  /** Gives every piece the transparency and the section that are wanted. */
  private paint(): void {
    for (const { material } of [...this.pieces.fine, ...this.pieces.coarse]) {
      const opacity = SIDES.find(({ side }) => side === material.side)?.opacity ?? 1;
      material.transparent = !this.opaque;
      material.opacity = this.opaque ? 1 : opacity;
      material.depthWrite = this.opaque;
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
    for (const { geometry, material } of this.pieces[grade]) {
      geometry.dispose();
      material.dispose();
    }
    this.pieces[grade] = [];
    this.grades[grade].clear();
  }
}
