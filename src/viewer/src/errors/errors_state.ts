/** The errors of the tool that are asked for, and those that were computed. */

import { batch, computed, effect, signal, untracked } from "@preact/signals";
import type { ErrorMapSummary, MeshError } from "verne-client";
import { inWords, verne } from "../api/client";
import { latest } from "../api/latest";
import { readGlb, type GlbSurface } from "../geometry/glb";
import { JobRun } from "../state/job_run";
import {
  change,
  changeWorkspace,
  machine,
  overTable,
  tool,
  view,
  wanted,
  workspaceAngles,
} from "../state/store";
import type { ErrorTolerances } from "../state/view";
import { errorRequest } from "./error_request";

export const run = new JobRun();
export const settings = computed(() => view.value.errors);
export const map = signal<ErrorMapSummary | null>(null);
/** The error whose bands the surface has. */
export const chosen = signal<MeshError>("tip_worst");
export const shown = signal(true);
/** The surface in the bands of the error that is chosen; null while it is loaded. */
export const surface = signal<GlbSurface | null>(null);

export function setTolerance(part: Partial<ErrorTolerances>): void {
  const { errors } = view.peek();
  change({ errors: { ...errors, tolerances: { ...errors.tolerances, ...part } } });
}

/** The request as text; null where none is possible. */
const question = computed(() => {
  const known = machine.value;
  const angles = workspaceAngles.value;
  if (!known || !angles) return null;
  const { kind } = wanted.value;
  const common = { machine: known.ref, kind, toolLength: tool.value, angles, overTable: overTable.value };
  const request = errorRequest(common, settings.value.tolerances);
  return request && JSON.stringify(request);
});

export const possible = computed(() => question.value !== null);
const answered = signal<string | null>(null);
/** Whether the settings have changed since the errors were computed. */
export const outdated = computed(() => map.value !== null && answered.value !== question.value);

/** Another machine has other errors. */
effect(() => {
  if (!machine.value) return;
  untracked(() => {
    run.abandon();
    map.value = null;
  });
});

const load = latest<{ id: string; error: MeshError }>(async ({ id, error }) => {
  try {
    const found = readGlb(await verne.mesh(id, "glb", { error }));
    if (map.peek()?.id === id && chosen.peek() === error) surface.value = found;
  } catch (thrown) {
    run.note.value = inWords(thrown);
  }
});

effect(() => {
  const found = map.value;
  const error = chosen.value;
  surface.value = null;
  if (found && found.triangles > 0) load({ id: found.id, error });
});

export async function compute(): Promise<void> {
  const asked = question.peek();
  if (asked === null) return;
  const found = await run.run((wait) =>
    verne.errorMap(JSON.parse(asked) as Parameters<typeof verne.errorMap>[0], wait),
  );
  if (!found) return;
  batch(() => {
    answered.value = asked;
    map.value = found;
    shown.value = true;
    // Both surfaces are in the same place.
    changeWorkspace({ shown: false });
  });
}
