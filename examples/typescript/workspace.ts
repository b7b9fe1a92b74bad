// Shows the workspace of a tool on the part: asks a verne service for it, and draws its surface with three.js.
import { Box3, HemisphereLight, PerspectiveCamera, Scene, Sphere, WebGLRenderer } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { Verne } from "verne-client";

const status = document.querySelector("p")!;
const server = new URLSearchParams(location.search).get("server") ?? "http://127.0.0.1:8080";
const verne = new Verne(server);
const workspace = await verne.workspace(
  { kind: "part", tool_length: 50, table_clearance: 0 },
  { onProgress: ({ progress }) => (status.textContent = `${Math.round(100 * progress)} %`) },
);
const surface = await new GLTFLoader().parseAsync(await verne.mesh(workspace.id, "glb"), "");
if ("volume" in workspace && workspace.volume) status.textContent = `${(workspace.volume / 1e9).toFixed(4)} m³`;

const scene = new Scene();
scene.add(surface.scene, new HemisphereLight("white", "grey", 3));
const { center, radius } = new Box3().setFromObject(surface.scene).getBoundingSphere(new Sphere());
const camera = new PerspectiveCamera(40, innerWidth / innerHeight, radius / 10, radius * 10);
camera.position.set(1, 1, 2).multiplyScalar(1.1 * radius).add(center);
const renderer = new WebGLRenderer({ antialias: true, alpha: true });
renderer.setSize(innerWidth, innerHeight);
document.body.append(renderer.domElement);
const controls = new OrbitControls(camera, renderer.domElement);
controls.target.copy(center);
controls.addEventListener("change", () => renderer.render(scene, camera));
controls.update();
document.body.dataset.drawn = "yes";
