/** Moves the machine: what is wanted goes to /fk or /ik, what comes back is shown. */

import { batch } from "@preact/signals";
import { unwrap, type Answer, type PlatformPose, type Schemas } from "verne-client";
import { failureOf, inWords, verne } from "../api/client";
import { fieldFaults, type FieldFaults } from "../api/faults";
import { latest } from "../api/latest";
import { broken, reasonOf } from "../words/limits";
import {
  change,
  failure,
  ghosts,
  heading,
  machine,
  overTable,
  position,
  refusal,
  view,
  wantedJoints,
  type Position,
} from "./store";
import type { Target } from "./target";
import { clamp, fromList, toList, travels } from "./joints";
import type { Joints } from "./view";

type TargetPose = Schemas["TargetPose"];

/** A target without a posture, or with one that breaks a limit. */
class RefusedError extends Error {}

/** Leads the machine there; while an answer is awaited, the newest target replaces those that wait. */
export function moveTo(target: Target): void {
  heading.value = target;
  send(target);
}

const send = latest<Target>(async (target) => {
  try {
    await go(target);
  } catch (thrown) {
    failure.value = failureOf(thrown, () => moveTo(target));
  } finally {
    if (heading.peek() === target) heading.value = null;
  }
});

/** Goes there if the machine can; otherwise the refusal says why not. */
async function go(target: Target): Promise<void> {
  const asked = machine.peek();
  try {
    const found = target.by === "joints" ? await byJoints(target) : await byPose(target);
    // Meanwhile another machine may have been taken.
    if (asked === machine.peek()) await show(found, target);
    failure.value = null;
  } catch (thrown) {
    const fields = fieldFaults(thrown);
    const faulty = Object.keys(fields).length > 0;
    if (!faulty && !(thrown instanceof RefusedError)) throw thrown;
    if (asked !== machine.peek()) return;
    refusal.value = { target, fields, sentence: faulty ? sentenceOf(fields) : inWords(thrown) };
  }
}

/** Solves anew where the machine stands: after a change of tool, machine or ghosts. */
export function stay(): void {
  const joints = view.value.joints ?? machine.value?.home.joints;
  if (joints) moveTo({ by: "joints", joints });
}

/** Puts the machine where the view says; answers why that is impossible, and null if it stands there. */
export async function arrive(joints: Joints): Promise<string | null> {
  await go({ by: "joints", joints });
  const refused = refusal.peek();
  refusal.value = null;
  return refused?.sentence ?? null;
}

/** Moves one joint (0 to 2: sliders, 3: tilt, 4: turn) from where it is wanted: no step is lost while answers are awaited. */
export function jog(joint: number, by: number): void {
  const from = wantedJoints.peek();
  const limits = machine.peek()?.definition.limits;
  if (!from || !limits) return;
  const [low = -Infinity, high = Infinity] = travels(limits)[joint] ?? [];
  const value = (joints: number[]) => joints[joint] ?? 0;
  const now = value(toList(from));
  // A joint beyond its travel can return.
  const next = clamp(now + by, Math.min(low, now), Math.max(high, now));
  moveTo({ by: "joints", joints: fromList(toList(from).with(joint, next)) });
}

/** Takes up a ghost's position. */
export function pick(ghost: Position): void {
  const { working, platform } = ghost.solution;
  moveTo({ by: "joints", joints: ghost.joints, mode: working ? null : platform });
}

async function byJoints({ joints, mode = view.value.mode }: Target & { by: "joints" }): Promise<Position> {
  const answer = await forward(joints, mode);
  const solution = answer.solutions[0];
  if (!solution) throw new RefusedError(reasonOf(answer));
  return { joints, solution, notChecked: answer.not_checked };
}

/** The pose's working solution if it keeps every limit; in another mode, the one nearest to where the machine is. */
async function byPose(target: Target & { by: "part" | "tool" | "platform" }): Promise<Position> {
  const { mode } = view.value;
  const here = position.value?.joints;
  const near = here && (target.by === "part" ? here : { rho: here.rho });
  const answer = unwrap(
    await verne.api.POST("/ik", {
      body: {
        ...(target.by === "part" ? question() : withoutTable()),
        frame: target.by,
        pose: target.pose,
        solutions: mode ? "all" : "working",
        ...(near && { near }),
      },
    }),
  );
  const solution = answer.solutions[0];
  if (!solution?.joints) throw new RefusedError(reasonOf(answer));
  if (!mode && !solution.feasible) throw new RefusedError(`Not allowed: ${broken(solution.margins.worst)}.`);
  const joints = asJoints(solution.joints, here);
  if (target.by === "part") return { joints, solution, notChecked: answer.not_checked };
  const found = await byJoints({ by: "joints", joints, mode: mode && solution.platform });
  const above = found.solution.margins.table_clearance;
  if (!mode && above && above.value < 0) throw new RefusedError(`Not allowed: ${broken(above)}.`);
  return found;
}

async function show(found: Position, target: Target): Promise<void> {
  const { platform, working } = found.solution;
  batch(() => {
    if (heading.peek() === target) heading.value = null;
    position.value = found;
    refusal.value = null;
    change({ joints: found.joints, mode: working ? null : platform });
  });
  // Feasible ones first; sorting keeps the order of equal ones.
  const rank = ({ solution: { feasible, working } }: Position) => (feasible ? 0 : 2) + (working ? 0 : 1);
  ghosts.value = (await others(found)).sort((a, b) => rank(a) - rank(b));
}

/** Every position with the same sliders, or with the same tool pose. */
async function others({ joints, solution }: Position): Promise<Position[]> {
  switch (view.value.ghosts) {
    case "none":
      return [];
    case "assembly": {
      const body = { ...question(), joints, solutions: "all" as const };
      const answer = unwrap(await verne.api.POST("/fk", { body }));
      return answer.solutions.map((other) => ({ joints, solution: other, notChecked: answer.not_checked }));
    }
    case "platform": {
      const { x, y, z } = solution.platform;
      return inverse("platform", { x, y, z }, joints);
    }
    case "inverse": {
      if (!solution.part) return [];
      const { x, y, z, phi1, phi2 } = solution.part;
      return inverse("part", { x, y, z, phi1, phi2 }, joints);
    }
  }
}

async function inverse(frame: "platform" | "part", pose: TargetPose, here: Joints): Promise<Position[]> {
  const asked = frame === "part" ? question() : withoutTable();
  const body = { ...asked, frame, pose, solutions: "all" as const };
  const answer = unwrap(await verne.api.POST("/ik", { body }));
  return answer.solutions.map((solution) => ({
    joints: asJoints(solution.joints, here),
    solution,
    notChecked: answer.not_checked,
  }));
}

async function forward(joints: Joints, mode: PlatformPose | null): Promise<Answer> {
  return unwrap(await verne.api.POST("/fk", { body: forwardQuestion(joints, mode) }));
}

/** The request for the posture at some joints: the working one, or the one nearest to `mode`. */
export function forwardQuestion(joints: Joints, mode: PlatformPose | null) {
  const more = mode ? { solutions: "all" as const, near: mode } : { solutions: "working" as const };
  return { ...question(), joints, ...more };
}

function question() {
  return { ...withoutTable(), ...overTable.value };
}

/** Where the table's tilt is left open, the height over it cannot be asked for. */
function withoutTable() {
  return { machine: machine.value?.ref ?? view.value.machine, tool_length: view.value.tool };
}

/** Which fields the service accepts no such value in. */
function sentenceOf(fields: FieldFaults): string {
  return Object.entries(fields)
    .map(([pointer, detail]) => `${pointer.replace(/^.*\//, "")}: ${detail}`)
    .join("; ");
}

function asJoints(found: Schemas["Joints"] | undefined, here: Joints | undefined): Joints {
  const [a = 0, b = 0, c = 0] = found?.rho ?? [];
  return {
    rho: [a, b, c],
    theta1: found?.theta1 ?? here?.theta1 ?? 0,
    theta2: found?.theta2 ?? here?.theta2 ?? 0,
  };
}
