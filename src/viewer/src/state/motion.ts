/** Moves the machine: what is wanted goes to /fk or /ik, what comes back is shown. */

import { batch } from "@preact/signals";
import { unwrap, type Answer, type PlatformPose, type Schemas } from "verne-client";
import { inWords, verne } from "../api/client";
import { latest } from "../api/latest";
import { broken, refusal } from "../words/limits";
import {
  change,
  complaint,
  failure,
  ghosts,
  machine,
  overTable,
  position,
  view,
  type Complaint,
  type Position,
} from "./store";
import type { Joints } from "./view";

type TargetPose = Schemas["TargetPose"];

export type Target =
  | { by: "joints"; joints: Joints; mode?: PlatformPose | null }
  | { by: "part"; pose: TargetPose & { phi1: number; phi2: number } }
  | { by: "tool"; pose: { x: number; y: number; z: number } };

/** One request under way, the latest wins. */
export const moveTo = latest<Target>(async (target) => {
  try {
    const found = target.by === "joints" ? await byJoints(target) : await byPose(target);
    if (found) await show(found);
    failure.value = null;
  } catch (thrown) {
    failure.value = inWords(thrown);
  }
});

/** Solves anew where the machine stands: after a change of tool, machine or ghosts. */
export function stay(): void {
  const joints = view.value.joints ?? machine.value?.home.joints;
  if (joints) moveTo({ by: "joints", joints });
}

/** Takes up a ghost's position. */
export function pick(ghost: Position): void {
  const { working, platform } = ghost.solution;
  moveTo({ by: "joints", joints: ghost.joints, mode: working ? null : platform });
}

async function byJoints({
  joints,
  mode = view.value.mode,
}: Target & { by: "joints" }): Promise<Position | null> {
  const answer = await forward(joints, mode);
  const solution = answer.solutions[0];
  if (solution) return { joints, solution };
  refuse({ sentence: refusal(answer) ?? "", wanted: null });
  return null;
}

/** The pose's working solution if it keeps every limit; in another mode, the one nearest to where the machine is. */
async function byPose(target: Target & { by: "part" | "tool" }): Promise<Position | null> {
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
  const { x, y, z } = target.pose;
  const wanted = { frame: target.by === "part" ? ("part" as const) : ("base" as const), x, y, z };
  const solution = answer.solutions[0];
  if (!solution?.joints) {
    refuse({ sentence: refusal(answer) ?? "", wanted });
    return null;
  }
  if (!mode && !solution.feasible) {
    refuse({ sentence: `Not allowed: ${broken(solution.margins.worst)}.`, wanted });
    return null;
  }
  const joints = asJoints(solution.joints, here);
  if (target.by === "part") return { joints, solution };
  const found = await byJoints({ by: "joints", joints, mode: mode && solution.platform });
  const above = found?.solution.margins.table_clearance;
  if (!mode && above && above.value < 0) {
    refuse({ sentence: `Not allowed: ${broken(above)}.`, wanted });
    return null;
  }
  return found;
}

async function show(found: Position): Promise<void> {
  const { platform, working } = found.solution;
  batch(() => {
    position.value = found;
    complaint.value = null;
    change({ joints: found.joints, mode: working ? null : platform });
  });
  ghosts.value = await others(found);
}

/** Every position with the same sliders, or with the same tool pose. */
async function others({ joints, solution }: Position): Promise<Position[]> {
  switch (view.value.ghosts) {
    case "none":
      return [];
    case "assembly": {
      const body = { ...question(), joints, solutions: "all" as const };
      const answer = unwrap(await verne.api.POST("/fk", { body }));
      return answer.solutions.map((other) => ({ joints, solution: other }));
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
  return answer.solutions.map((solution) => ({ joints: asJoints(solution.joints, here), solution }));
}

async function forward(joints: Joints, mode: PlatformPose | null): Promise<Answer> {
  const body = { ...question(), joints };
  const more = mode ? { solutions: "all" as const, near: mode } : { solutions: "working" as const };
  return unwrap(await verne.api.POST("/fk", { body: { ...body, ...more } }));
}

function question() {
  return { ...withoutTable(), ...overTable.value };
}

/** Where the table's tilt is left open, the height over it cannot be asked for. */
function withoutTable() {
  return { machine: machine.value?.ref ?? view.value.machine, tool_length: view.value.tool };
}

function refuse(news: Complaint): void {
  complaint.value = news;
}

function asJoints(found: Schemas["Joints"] | undefined, here: Joints | undefined): Joints {
  const [a = 0, b = 0, c = 0] = found?.rho ?? [];
  return {
    rho: [a, b, c],
    theta1: found?.theta1 ?? here?.theta1 ?? 0,
    theta2: found?.theta2 ?? here?.theta2 ?? 0,
  };
}
