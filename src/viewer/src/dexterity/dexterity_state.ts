/** The dexterity map that is asked for, and the one that was computed. */

import { batch, computed, effect, signal, untracked } from "@preact/signals";
import type { DexterityBody, DexteritySummary, Schemas } from "verne-client";
import { verne } from "../api/client";
import { JobRun } from "../state/job_run";
import { change, changeWorkspace, machine, overTable, tool, view, workspaceAngles } from "../state/store";
import type { DexterityView } from "../state/view";
import { layersOf, type Layer } from "./reached_share";

export interface DexterityMap {
  summary: DexteritySummary;
  layers: Layer[];
}

export const run = new JobRun();
export const settings = computed(() => view.value.dexterity);
export const set = (part: Partial<DexterityView>) =>
  change({ dexterity: { ...view.peek().dexterity, ...part } });
export const map = signal<DexterityMap | null>(null);
export const shown = signal(true);
/** Whether all layers are drawn, or the one at `height`. */
export const allLayers = signal(false);
/** The place of the layer in the map. */
export const height = signal(0);

/** The layers that the scene shows. */
export const visible = computed<Layer[]>(() => {
  const layers = shown.value ? (map.value?.layers ?? []) : [];
  return allLayers.value ? layers : layers.slice(height.value, height.value + 1);
});

/** The request as text; null while it is not known where the machine stands. */
const question = computed(() => {
  const known = machine.value;
  const angles = workspaceAngles.value;
  if (!known || !angles) return null;
  const { from, to, cell } = settings.value;
  const body: DexterityBody = {
    machine: known.ref,
    tool_length: tool.value,
    phi1: { from: Math.min(from, to), to: Math.max(from, to) },
    phi2: angles.phi2,
    cell,
    ...overTable.value,
  };
  return JSON.stringify(body);
});

export const possible = computed(() => question.value !== null);

const answered = signal<string | null>(null);
/** Whether the settings have changed since the map was computed. */
export const outdated = computed(() => map.value !== null && answered.value !== question.value);

/** Another machine has another map. */
effect(() => {
  if (!machine.value) return;
  untracked(() => {
    run.abandon();
    map.value = null;
  });
});

export async function compute(): Promise<void> {
  const asked = question.peek();
  if (asked === null) return;
  const body = JSON.parse(asked) as DexterityBody;
  const found = await run.run(async (wait) => {
    const summary = await verne.dexterity(body, wait);
    const bytes = await verne.file(`/workspace/${summary.id}/cells.json`, wait);
    const cells = JSON.parse(new TextDecoder().decode(bytes)) as Schemas["DexterityCells"];
    return { summary, layers: layersOf(cells, body.phi1.to - body.phi1.from) };
  });
  if (!found) return;
  batch(() => {
    answered.value = asked;
    map.value = found;
    height.value = Math.floor(found.layers.length / 2);
    shown.value = true;
    // Its surface would hide the layers.
    changeWorkspace({ shown: false });
  });
}
