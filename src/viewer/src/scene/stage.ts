/** Cameras, light and canvas; draws when something changed and not otherwise. */

import {
  DirectionalLight,
  HemisphereLight,
  MathUtils,
  OrthographicCamera,
  PerspectiveCamera,
  Scene,
  Vector3,
  WebGLRenderer,
  type Object3D,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { Camera } from "../state/view";
import { framing } from "../geometry/framing";
import { Resolution } from "./resolution";

/** Nearest and farthest that the camera goes, and sees, in units of a machine with rods of a metre. */
const REACH = { from: 0.2, to: 25, near: 0.05, far: 60 };

export class Stage {
  readonly scene = new Scene();
  readonly renderer: WebGLRenderer;
  readonly controls: OrbitControls;
  /** Called before each picture. */
  readonly beforeDrawing: (() => void)[] = [];
  /** Called when the other camera is taken. */
  readonly cameraTaken: ((camera: Stage["camera"]) => void)[] = [];
  readonly resolution: Resolution;
  private readonly perspective = new PerspectiveCamera(32, 1, REACH.near, REACH.far);
  private readonly parallel = new OrthographicCamera(-1, 1, 1, -1, REACH.near, REACH.far);
  private taken: PerspectiveCamera | OrthographicCamera = this.perspective;
  private aspect = 1;
  private asked = false;
  private open = false;

  constructor(
    readonly canvas: HTMLCanvasElement,
    drawing: "software" | "hardware",
  ) {
    // Smoothing edges by the processor triples the work: there the picture at rest is drawn twice as fine instead.
    const software = drawing === "software";
    this.renderer = new WebGLRenderer({ canvas, antialias: !software, powerPreference: "high-performance" });
    this.renderer.localClippingEnabled = true;
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.listenToKeyEvents(canvas);
    this.controls.addEventListener("change", () => this.draw());
    this.resolution = new Resolution(this.renderer, software ? 2 : 1, () => this.draw());
    this.light();
    this.reach(1);
    new ResizeObserver(() => this.fit()).observe(canvas.parentElement ?? canvas);
    this.fit();
  }

  get camera(): PerspectiveCamera | OrthographicCamera {
    return this.taken;
  }

  /** The vertical angle that a camera with perspective sees, radians. */
  get angle(): number {
    return MathUtils.degToRad(this.perspective.fov);
  }

  /** What a pixel covers at the point that is looked at, metres. */
  get pixel(): number {
    const { height } = this.seen();
    const distance = this.camera.position.distanceTo(this.controls.target);
    return (height ?? 2 * distance * Math.tan(this.angle / 2)) / this.canvas.clientHeight;
  }

  /** Suits distances to a machine's size, 1 for one with rods of a metre. */
  reach(size: number): void {
    this.controls.minDistance = REACH.from * size;
    this.controls.maxDistance = REACH.to * size;
    for (const camera of [this.perspective, this.parallel]) {
      camera.near = REACH.near * size;
      camera.far = REACH.far * size;
      camera.updateProjectionMatrix();
    }
  }

  /** Until `begin`, pictures that are asked for are not drawn. */
  begin(): void {
    this.open = true;
    this.draw();
  }

  /** Lets the graphics processor translate the programs that bodies need, without waiting for it. */
  prepare(bodies: Object3D): void {
    this.renderer.compile(bodies, this.camera, this.scene);
  }

  /** Asks for a picture. */
  draw(): void {
    if (this.asked || !this.open) return;
    this.asked = true;
    requestAnimationFrame((now) => {
      this.asked = false;
      this.resolution.prepare(now);
      this.render();
      // For those who wait for a picture: how many there were, and whether this one stays.
      this.canvas.dataset["picture"] = this.resolution.moving ? "quick" : "good";
      const drawn = Number(this.canvas.dataset["pictures"] ?? 0) + 1;
      this.canvas.dataset["pictures"] = String(drawn);
    });
  }

  /** Draws now. */
  render(): void {
    for (const call of this.beforeDrawing) call();
    this.renderer.render(this.scene, this.camera);
  }

  look({ eye, target, height }: Camera): void {
    const camera = height === null ? this.perspective : this.parallel;
    if (camera === this.parallel) {
      this.parallel.top = (height ?? 1) / 2;
      this.parallel.bottom = -this.parallel.top;
      this.parallel.zoom = 1;
      this.widen();
    }
    if (camera !== this.taken) {
      this.taken = camera;
      this.controls.object = camera;
      for (const call of this.cameraTaken) call(camera);
    }
    camera.position.set(...eye);
    this.controls.target.set(...target);
    this.controls.update();
    this.canvas.dataset["camera"] = height === null ? "perspective" : "parallel";
    this.draw();
  }

  seen(): Camera {
    const { top, bottom, zoom } = this.parallel;
    return {
      eye: this.camera.position.toArray(),
      target: this.controls.target.toArray(),
      height: this.camera === this.parallel ? (top - bottom) / zoom : null,
    };
  }

  /** Looks at points from a direction, so that all of them are seen. */
  frame(points: Vector3[], from: Vector3, parallel: boolean): void {
    this.look(framing(points, from, parallel ? null : this.angle / 2, this.aspect));
  }

  private fit(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement ?? this.canvas;
    if (width === 0 || height === 0) return;
    this.aspect = width / height;
    this.widen();
    this.renderer.setSize(width, height, false);
    this.draw();
  }

  private widen(): void {
    this.perspective.aspect = this.aspect;
    this.perspective.updateProjectionMatrix();
    this.parallel.right = this.parallel.top * this.aspect;
    this.parallel.left = -this.parallel.right;
    this.parallel.updateProjectionMatrix();
  }

  private light(): void {
    const sky = new HemisphereLight(0xffffff, 0x8a8f96, 1.6);
    const sun = new DirectionalLight(0xffffff, 1.7);
    sun.position.set(2.5, 4, 3);
    const back = new DirectionalLight(0xffffff, 0.5);
    back.position.set(-3, 1, -2);
    this.scene.add(sky, sun, back);
  }
}
