/** Which machine is in use: a published one, or one that was dropped on the page. */

import { batch } from "@preact/signals";
import { unwrap, type Answer, type Machine, type MachineRef } from "verne-client";
import { verne } from "../api/client";
import { change, refusal, view, ghosts, machine, published, workspace, type InUse } from "./store";
import { arrive, stay } from "./motion";
import type { Joints, View } from "./view";

export async function listMachines(): Promise<void> {
  published.value = unwrap(await verne.api.GET("/machines")).machines;
}

/** Loads the view's machine. Nothing says yet where it stands. */
export async function loadMachine({ machine: name, own }: View): Promise<void> {
  use(own ? await examined(own) : await publishedMachine(name));
}

/** Takes a published machine, from its home. */
export async function takePublished(name: string): Promise<void> {
  const next = await publishedMachine(name);
  change({ machine: name, own: null, joints: null, mode: null });
  use(next);
  stay();
}

/** Takes a machine of one's own, from its home; the service's faults are thrown. */
export async function takeOwn(own: Machine): Promise<void> {
  const next = await examined(own);
  change({ own, joints: null, mode: null });
  use(next);
  stay();
}

/** Takes a changed machine, which stands where it stood if it can; the service's faults are thrown. */
export async function changeMachine(own: Machine): Promise<void> {
  const next = await examined(own);
  const { joints } = view.peek();
  change({ own });
  use(next);
  if (joints && (await arrive(joints)) === null) return;
  change({ joints: null, mode: null });
  await arrive(next.home.joints);
}

function use(next: InUse): void {
  batch(() => {
    machine.value = next;
    ghosts.value = [];
    refusal.value = null;
    workspace.value = null;
  });
}

export function home(): Joints | null {
  return machine.peek()?.home.joints ?? null;
}

async function examined(own: Machine): Promise<InUse> {
  return inUse(own, own, await symmetric(own));
}

async function publishedMachine(name: string): Promise<InUse> {
  // Neither request waits for the other: the first picture waits for both.
  const [found, answer] = await Promise.all([
    verne.api.GET("/machines/{name}", { params: { path: { name } } }),
    symmetric(name),
  ]);
  return inUse(name, unwrap(found).definition, answer);
}

/** The posture in which everything is symmetric. */
async function symmetric(ref: MachineRef): Promise<Answer> {
  const body = { machine: ref, frame: "platform" as const, pose: { x: 0, y: 0, z: 0 } };
  return unwrap(await verne.api.POST("/ik", { body }));
}

/** Home is the symmetric posture, with the sliders about the middle of their strokes. */
function inUse(ref: MachineRef, definition: Machine, answer: Answer): InUse {
  const home = answer.solutions[0];
  const rho = home?.joints?.rho ?? [0, 0, 0];
  const { stroke } = definition.limits;
  const middle = mean(stroke.map(([low = 0, high = 0]) => (low + high) / 2));
  const shift = middle - mean(rho);
  const [a = 0, b = 0, c = 0] = rho.map((at) => Math.round((at + shift) * 1000) / 1000);
  const gap = home?.margins.rod_interference ?? 0;
  return {
    ref,
    definition,
    hash: answer.machine.hash,
    home: {
      det: home?.conditioning.det ?? 1,
      rodDistance: gap + 2 * definition.geometry.rod_radius,
      joints: { rho: [a, b, c], theta1: 0, theta2: 0 },
    },
  };
}

function mean(values: number[]): number {
  return values.reduce((sum, value) => sum + value, 0) / values.length;
}
