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
} from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { BASE, Refused, type WorkspaceSummary } from "../api/client";
import { send } from "../api/key";
import type { Surface } from "../state/store";
import { shares } from "../geometry/shares";

/** As it is, and coarser for machines that cannot move it so. */
type Grade = "fine" | "coarse";

export class WorkspaceMesh {
  readonly group = new Group();
  private readonly grades = { fine: new Group(), coarse: new Group() };
  private readonly shown: Record<Grade, string | null> = { fine: null, coarse: null };
  private readonly loader = new GLTFLoader();
  private readonly inside = new MeshLambertMaterial({ vertexColors: true, side: BackSide });
  private readonly outside = new MeshLambertMaterial({ vertexColors: true, side: FrontSide });
  private readonly plane = new Plane();
  /** In the GLB's own frame, metres: what lies below it is shown. */
  private height: number | null = null;

  constructor() {
    this.group.matrixAutoUpdate = false;
    this.group.add(this.grades.fine, this.grades.coarse);
    this.quick(false);
    this.solid(false);
  }

  solid(solid: boolean): void {
    for (const [material, opacity] of [
      [this.inside, 0.22],
      [this.outside, 0.36],
    ] as const) {
      material.transparent = !solid;
      material.opacity = solid ? 1 : opacity;
      material.depthWrite = solid;
      material.needsUpdate = true;
    }
  }

  /** Loads and shows; answers the pieces of the surface, or null if something newer came between. */
  async show(summary: WorkspaceSummary | null, grade: Grade = "fine"): Promise<Surface[] | null> {
    this.shown[grade] = summary?.id ?? null;
    if (!summary || summary.triangles === 0) {
      clear(this.grades[grade]);
      return [];
    }
    const answer = await send(new Request(`${BASE}${summary.links.mesh}?format=glb`));
    if (!answer.ok) throw new Refused({ detail: `The mesh cannot be loaded: ${answer.status}.` });
    const loaded = await this.loader.parseAsync(await answer.arrayBuffer(), "");
    if (this.shown[grade] !== summary.id) return null;
    clear(this.grades[grade]);
    let pieces: Surface[] = [];
    loaded.scene.traverse((node) => {
      if (!(node instanceof Mesh)) return;
      const geometry = node.geometry as BufferGeometry;
      pieces = shares(geometry, (node.userData["palette"] ?? []) as Omit<Surface, "share">[]);
      for (const [order, material] of [this.inside, this.outside].entries()) {
        const side = new Mesh(geometry, material);
        side.position.copy(node.position);
        side.renderOrder = 10 + order;
        this.grades[grade].add(side);
      }
    });
    return pieces;
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
    const planes = height === null ? [] : [this.plane];
    this.inside.clippingPlanes = planes;
    this.outside.clippingPlanes = planes;
    this.turnPlane();
  }

  private turnPlane(): void {
    if (this.height === null) return;
    this.plane.setFromNormalAndCoplanarPoint(new Vector3(0, -1, 0), new Vector3(0, this.height, 0));
    this.plane.applyMatrix4(this.group.matrix);
  }
}

function clear(group: Group): void {
  for (const side of group.children) if (side instanceof Mesh) (side.geometry as BufferGeometry).dispose();
  group.clear();
}
