/** Camera, light and canvas; draws when something changed and not otherwise. */

import { DirectionalLight, HemisphereLight, PerspectiveCamera, Scene, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { Camera } from "../state/view";
import { Resolution } from "./resolution";

export class Stage {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(32, 1, 0.05, 60);
  readonly renderer: WebGLRenderer;
  readonly controls: OrbitControls;
  /** Called before each picture. */
  readonly beforeDrawing: (() => void)[] = [];
  readonly resolution: Resolution;
  private asked = false;

  constructor(
    readonly canvas: HTMLCanvasElement,
    drawing: "software" | "hardware",
  ) {
    // Smoothing edges by the processor triples the work: there the picture at rest is drawn twice as fine instead.
    const software = drawing === "software";
    this.renderer = new WebGLRenderer({ canvas, antialias: !software, powerPreference: "high-performance" });
    this.renderer.localClippingEnabled = true;
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.minDistance = 0.2;
    this.controls.maxDistance = 25;
    this.controls.listenToKeyEvents(canvas);
    this.controls.addEventListener("change", () => this.draw());
    this.resolution = new Resolution(this.renderer, software ? 2 : 1, () => this.draw());
    this.light();
    new ResizeObserver(() => this.fit()).observe(canvas.parentElement ?? canvas);
    this.fit();
  }

  /** Asks for a picture. */
  draw(): void {
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame((now) => {
      this.asked = false;
      this.resolution.prepare(now);
      for (const call of this.beforeDrawing) call();
      this.renderer.render(this.scene, this.camera);
      // For those who wait for a picture: how many there were, and whether this one stays.
      this.canvas.dataset["picture"] = this.resolution.moving ? "quick" : "good";
      const drawn = Number(this.canvas.dataset["pictures"] ?? 0) + 1;
      this.canvas.dataset["pictures"] = String(drawn);
    });
  }

  look({ eye, target }: Camera): void {
    this.camera.position.set(...eye);
    this.controls.target.set(...target);
    this.controls.update();
    this.draw();
  }

  seen(): Camera {
    return { eye: this.camera.position.toArray(), target: this.controls.target.toArray() };
  }

  /** Looks at a ball from a direction, so that all of it is seen. */
  frame(centre: Vector3, radius: number, from: Vector3): void {
    const half = (this.camera.fov * Math.PI) / 360;
    const narrow = Math.atan(Math.tan(half) * Math.min(1, this.camera.aspect));
    const distance = radius / Math.sin(narrow);
    const eye = centre.clone().addScaledVector(from.clone().normalize(), distance);
    this.look({ eye: eye.toArray(), target: centre.toArray() });
  }

  private fit(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement ?? this.canvas;
    if (width === 0 || height === 0) return;
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.renderer.setSize(width, height, false);
    this.draw();
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
