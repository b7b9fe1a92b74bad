/** Keeps the workspace that is shown the one that the view asks for. */

import { batch, computed, effect, untracked } from "@preact/signals";
import { inWords, type WorkspaceRequest, type WorkspaceSummary } from "../api/client";
import { Cancelled, cancel } from "../api/jobs";
import { latest } from "../api/latest";
import { slice as fetchSlice, workspace as compute } from "../api/workspace";
import { computing, machine, slice, view, workspace, workspaceNote } from "./store";

/** A control that is being dragged is not asked at every step, ms. */
const REST = 120;

/** The question as text, so that equal ones are equal. */
const question = computed(() => {
  const { workspace: wanted, tool } = view.value;
  const known = machine.value;
  if (!known || !wanted.shown) return null;
  const { kind, phi1, phi2, tolerance } = wanted;
  const request: WorkspaceRequest = { machine: known.ref, kind, tolerance };
  if (kind !== "platform") request.tool_length = tool;
  if (kind === "part") Object.assign(request, { phi1, phi2 });
  return JSON.stringify(request);
});

const cut = computed(() => {
  const { section } = view.value;
  const found = workspace.value;
  return found && section !== null ? JSON.stringify({ id: found.id, z: section }) : null;
});

let stop = new AbortController();

export function keepWorkspace(): void {
  effect(() => {
    const asked = question.value;
    untracked(abandon);
    if (asked === null) {
      workspace.value = null;
      return;
    }
    const timer = setTimeout(() => void ask(JSON.parse(asked) as WorkspaceRequest), REST);
    return () => clearTimeout(timer);
  });
  const askSlice = latest<string>(async (asked) => {
    const { id, z } = JSON.parse(asked) as { id: string; z: number };
    const found = await fetchSlice(id, z).catch(() => null);
    if (cut.peek() !== null) slice.value = found;
  });
  effect(() => {
    if (cut.value === null) slice.value = null;
    else askSlice(cut.value);
  });
}

/** Asks again what was cancelled or failed. */
export function again(): void {
  const asked = question.peek();
  if (asked !== null) void ask(JSON.parse(asked) as WorkspaceRequest);
}

/** Cancels on the operator's word. */
export async function cancelComputation(): Promise<void> {
  const job = computing.peek()?.job;
  if (job) await cancel(job);
  else stop.abort();
}

/** What is no longer wanted need not be computed. */
function abandon(): void {
  const job = computing.peek()?.job;
  stop.abort();
  if (job) void cancel(job).catch(() => undefined);
  computing.value = null;
}

async function ask(request: WorkspaceRequest): Promise<void> {
  const own = (stop = new AbortController());
  computing.value = { progress: null, state: "waiting", job: null };
  workspaceNote.value = null;
  try {
    const found = await compute(request, {
      signal: own.signal,
      progress: ({ id, state, progress }) => {
        if (own === stop) computing.value = { progress, state: state === "queued" ? "queued" : "running", job: id };
      },
    });
    if (own === stop) finish(found, found.explanation ?? null);
  } catch (thrown) {
    if (own !== stop) return;
    const cancelled = thrown instanceof Cancelled || own.signal.aborted;
    finish(null, cancelled ? "Cancelled." : inWords(thrown));
  }
}

function finish(found: WorkspaceSummary | null, note: string | null): void {
  batch(() => {
    workspace.value = found;
    workspaceNote.value = note;
    computing.value = null;
  });
}
