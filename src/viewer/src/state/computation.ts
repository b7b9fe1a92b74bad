/** Keeps the workspace that is shown the one that the view asks for. */

import { batch, computed, effect, signal, untracked } from "@preact/signals";
import { CancelledError, type Watch, type WorkspaceRequest, type WorkspaceSummary } from "verne-client";
import { inWords, verne } from "../api/client";
import { latest } from "../api/latest";
import {
  computing,
  machine,
  overTable,
  section,
  slice,
  slowDrawing,
  standIn,
  tool,
  wanted,
  workspace,
  workspaceAngles,
  workspaceNote,
} from "./store";

/** A control that is being dragged is not asked at every step, ms. */
const REST = 120;

/** Seconds that an answer may take before it becomes a job with a progress bar. */
const WAIT = 1;

/** Triangles that a slow machine cannot move, and about as many as it can: they go with the tolerance's inverse. */
const MANY = 12_000;
const FEW = 5_000;

/** The question as text, so that equal ones are equal. */
export const question = computed(() => {
  const known = machine.value;
  if (!known || !wanted.value.shown) return null;
  const { kind, tolerance } = wanted.value;
  const request: WorkspaceRequest = { machine: known.ref, kind, tolerance };
  if (kind !== "platform") request.tool_length = tool.value;
  if (kind === "part") {
    if (!workspaceAngles.value) return null;
    Object.assign(request, { ...workspaceAngles.value, ...overTable.value });
  }
  return JSON.stringify(request);
});

/** The question that the workspace answers. */
const answered = signal<string | null>(null);

/** Whether the workspace that is shown is not the one that is wanted. */
export const outdated = computed(() => workspace.value !== null && answered.value !== question.value);

const cut = computed(() => {
  const found = workspace.value;
  return found && section.value !== null ? JSON.stringify({ id: found.id, z: section.value }) : null;
});

let stop = new AbortController();
let asking = false;

export function keepWorkspace(): void {
  effect(() => {
    const asked = question.value;
    untracked(abandon);
    if (asked === null) {
      workspace.value = null;
      return;
    }
    if (workspace.peek() && answered.peek() === asked) return;
    // The first one is not dragged.
    const timer = setTimeout(() => void ask(asked), asking ? REST : 0);
    asking = true;
    return () => clearTimeout(timer);
  });
  keepStandIn();
  const askSlice = latest<string>(async (asked) => {
    const { id, z } = JSON.parse(asked) as { id: string; z: number };
    const params = { path: { id }, query: { z } };
    const found = await verne.api.GET("/workspace/{id}/slice.json", { params }).catch(() => null);
    if (cut.peek() !== null) slice.value = found?.data ?? null;
  });
  effect(() => {
    if (cut.value === null) slice.value = null;
    else askSlice(cut.value);
  });
}

/** Where drawing is slow, a mesh of many triangles moves as a coarser one. */
function keepStandIn(): void {
  const ask = latest<WorkspaceRequest>(async (request) => {
    standIn.value = await compute(request).catch(() => null);
  });
  effect(() => {
    const found = workspace.value;
    const known = machine.value;
    standIn.value = null;
    if (!found || !known || !slowDrawing.value || found.triangles <= MANY) return;
    ask({
      ...found.request,
      machine: known.ref,
      tolerance: (found.request.tolerance * found.triangles) / FEW,
    });
  });
}

/** Asks again what was cancelled or failed. */
export function again(): void {
  const asked = question.peek();
  if (asked !== null) void ask(asked);
}

/** Cancels on the operator's word. */
export async function cancelComputation(): Promise<void> {
  const job = computing.peek()?.job;
  if (job) await verne.cancel(job);
  else stop.abort();
}

/** What is no longer wanted need not be computed. */
function abandon(): void {
  const job = computing.peek()?.job;
  stop.abort();
  if (job) void verne.cancel(job).catch(() => undefined);
  computing.value = null;
}

/** The summary of one workspace. */
async function compute(request: WorkspaceRequest, watch: Watch = {}): Promise<WorkspaceSummary> {
  const found = await verne.workspace(request, { ...watch, wait: WAIT });
  if ("volume" in found) return found;
  throw new Error("The service sent something else than the workspace's figures.");
}

async function ask(asked: string): Promise<void> {
  const own = (stop = new AbortController());
  computing.value = { progress: null, state: "waiting", job: null };
  workspaceNote.value = null;
  try {
    const found = await compute(JSON.parse(asked) as WorkspaceRequest, {
      signal: own.signal,
      onProgress: ({ id, state, progress }) => {
        if (own === stop)
          computing.value = { progress, state: state === "queued" ? "queued" : "running", job: id };
      },
    });
    if (own !== stop) return;
    batch(() => {
      workspace.value = found;
      answered.value = asked;
      end(found.explanation ?? null);
    });
  } catch (thrown) {
    if (own !== stop) return;
    const cancelled = thrown instanceof CancelledError || own.signal.aborted;
    end(cancelled ? "Cancelled." : inWords(thrown));
  }
}

/** The last workspace remains where none has been found. */
function end(note: string | null): void {
  batch(() => {
    workspaceNote.value = note;
    computing.value = null;
  });
}
