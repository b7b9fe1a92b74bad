/** Undo and redo of what moves or changes the machine: joints, mode, tool, machine. */

import { computed, effect, signal } from "@preact/signals";
import { failureOf } from "../api/client";
import { loadMachine } from "./machines";
import { stay } from "./motion";
import { change, failure, machine, view } from "./store";
import { differing, type Snapshot } from "./step";
import type { Joints, View } from "./view";

/** Changes of the same fields that follow each other faster are one step, ms. */
const PAUSE = 700;
/** Steps that are kept. */
const MOST = 200;

const past = signal<Snapshot[]>([]);
const future = signal<Snapshot[]>([]);
export const canUndo = computed(() => past.value.length > 0);
export const canRedo = computed(() => future.value.length > 0);

/** Joints of a program that is played: they are no steps. */
const passed = new WeakSet<Joints>();

let current: Snapshot | null = null;
let fields = "";
let changed = Number.NEGATIVE_INFINITY;

export function keepHistory(): void {
  effect(() => {
    const next = snapshot(view.value);
    // Without joints the machine is still on its way home.
    if (machine.value && next.joints) record(next);
  });
  addEventListener("keydown", (event) => {
    const key = event.key.toLowerCase();
    if (!(event.ctrlKey || event.metaKey) || event.altKey || typedIn(event.target)) return;
    if (key === "z" && !event.shiftKey) undo();
    else if (key === "y" || (key === "z" && event.shiftKey)) redo();
    else return;
    event.preventDefault();
  });
}

/** The machine comes to these joints without a step that can be undone. */
export function pass(joints: Joints): void {
  passed.add(joints);
}

export function undo(): void {
  step(past, future);
}

export function redo(): void {
  step(future, past);
}

function record(next: Snapshot): void {
  const before = current;
  const changes = before ? differing(before, next) : "";
  if (before && changes === "") return;
  const now = performance.now();
  if (before && next.joints && passed.has(next.joints) && next.program === before.program) {
    current = next;
    return;
  }
  const follows = changes === fields && now - changed < PAUSE && past.peek().length > 0;
  current = next;
  fields = changes;
  changed = now;
  if (!before) return;
  if (!follows) past.value = [...past.peek(), before].slice(-MOST);
  future.value = [];
}

function step(from: typeof past, to: typeof past): void {
  const [next] = from.peek().slice(-1);
  if (!next || !current) return;
  from.value = from.peek().slice(0, -1);
  to.value = [...to.peek(), current];
  const otherMachine = next.machine !== current.machine || next.own !== current.own;
  current = next;
  fields = "";
  change(next);
  void restore(otherMachine);
}

async function restore(otherMachine: boolean): Promise<void> {
  try {
    if (otherMachine) await loadMachine(view.peek());
    stay();
  } catch (thrown) {
    failure.value = failureOf(thrown, () => void restore(otherMachine));
  }
}

function snapshot({ machine, own, joints, mode, tool, radius, clearance, program }: View): Snapshot {
  return { machine, own, joints, mode, tool, radius, clearance, program };
}

/** Text that is typed has an undo of its own. */
function typedIn(target: EventTarget | null): boolean {
  return target instanceof HTMLInputElement && ["number", "text", "password"].includes(target.type);
}
