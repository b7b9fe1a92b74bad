/** The atlas of the machine, and the machine's place in it. */

import { computed, effect, signal } from "@preact/signals";
import type { Atlas, AtlasSpace, MachineRef } from "verne-client";
import { inWords, verne } from "../api/client";
import { latest } from "../api/latest";
import { moveTo } from "../state/motion";
import { change, machine, position, view } from "../state/store";
import { pointOf, slidersAt, solutionsAt, type Point } from "./atlas_plane";

interface Question {
  machine: MachineRef;
  space: AtlasSpace;
}

interface Answer {
  question: Question;
  atlas: Atlas;
}

const answer = signal<Answer | null>(null);
/** Why there is no atlas. */
export const trouble = signal<string | null>(null);
export const space = computed(() => view.value.atlas.space);
export const choose = (next: AtlasSpace) => change({ atlas: { ...view.peek().atlas, space: next } });

const question = computed<Question | null>(() => {
  const known = machine.value;
  return known && view.value.atlas.open ? { machine: known.ref, space: space.value } : null;
});

/** The atlas of the machine in the plane that is wanted; null while it is computed. */
export const atlas = computed(() => {
  const found = answer.value;
  const asked = { machine: machine.value?.ref, space: space.value };
  return found && found.question.machine === asked.machine && found.question.space === asked.space
    ? found.atlas
    : null;
});

/** Where the machine stands in the plane. */
export const here = computed<Point | null>(() => {
  const at = position.value;
  return at && pointOf(space.value, at.joints, at.solution.platform);
});

/** The number of solutions where the machine stands; null outside of the map. */
export const solutionsHere = computed(() =>
  atlas.value && here.value ? solutionsAt(here.value, atlas.value) : null,
);

const ask = latest<Question>(async (asked) => {
  try {
    const found = await verne.atlas(asked);
    if (question.peek() === asked) answer.value = { question: asked, atlas: found };
  } catch (thrown) {
    if (question.peek() === asked) trouble.value = inWords(thrown);
  }
});

effect(() => {
  const asked = question.value;
  if (!asked || atlas.peek()) return;
  trouble.value = null;
  ask(asked);
});

/** Leads the machine to a point of the plane: the table stays, and in the plane of the platform its height, too. */
export function go(point: Point): void {
  const at = position.peek();
  const known = machine.peek();
  if (!at || !known) return;
  if (space.peek() === "platform") {
    moveTo({ by: "platform", pose: { x: point[0], y: point[1], z: at.solution.platform.z } });
    return;
  }
  const rho = slidersAt(point, at.joints.rho[0], known.definition.limits);
  moveTo({ by: "joints", joints: { ...at.joints, rho } });
}
