/** Keeps the plan that is shown the one that the program and its settings ask for. */

import { batch, computed, effect, untracked } from "@preact/signals";
import {
  CancelledError,
  ProblemError,
  type Schemas,
  type ToolpathReport,
  type ToolpathRequest,
} from "verne-client";
import { inWords, verne } from "../api/client";
import { machine, overTable, type InUse } from "../state/store";
import {
  activity,
  faults,
  now,
  plan,
  playing,
  program,
  settings,
  trouble,
  type OpenProgram,
} from "./program_state";
import { readRows } from "./row_pieces";
import { toolpathRequest, type Settings } from "./settings";
import { times } from "./timeline";

/** A control that is being dragged is not asked at every step, ms. */
const REST = 250;
/** Seconds that an answer may take before it becomes a job with a progress bar. */
const WAIT = 1;

/** The question as text, so that equal ones are equal. */
export const question = computed(() => {
  const [open, known] = [program.value, machine.value];
  if (!open || !known) return null;
  return JSON.stringify(toolpathRequest(open.summary.id, known.ref, settings.value, overTable.value));
});

/** Whether the plan answers another question than the one that is asked now. */
export const outdated = computed(() => plan.value !== null && plan.value.asked !== question.value);

let stop = new AbortController();
let job: string | null = null;

/** Plans whenever the question changes. Returns how to end this. */
export function keepPlan(): () => void {
  return effect(() => {
    const asked = question.value;
    untracked(abandon);
    if (asked === null) return;
    const timer = setTimeout(() => void ask(asked), plan.peek() ? REST : 0);
    return () => clearTimeout(timer);
  });
}

/** Plans again what was cancelled or failed. */
export function planAgain(): void {
  const asked = question.peek();
  if (asked !== null) void ask(asked);
}

/** Cancels on the operator's word: the plan before remains. */
export async function cancelPlanning(): Promise<void> {
  const id = job;
  stop.abort();
  try {
    if (id) await verne.cancel(id);
  } catch (thrown) {
    trouble.value = inWords(thrown);
  }
}

export function forgetPlan(): void {
  abandon();
  batch(() => {
    plan.value = null;
    playing.value = false;
    now.value = 0;
  });
}

/** What is no longer wanted need not be computed. */
function abandon(): void {
  stop.abort();
  if (job) void verne.cancel(job).catch(() => undefined);
  job = null;
  stop = new AbortController();
}

async function ask(asked: string): Promise<void> {
  const [open, known] = [program.peek(), machine.peek()];
  if (!open || !known) return;
  const own = (stop = new AbortController());
  const current = () => own === stop;
  activity.value = { words: "Planning …", fraction: null };
  trouble.value = null;
  faults.value = [];
  try {
    const report = await verne.toolpath(JSON.parse(asked) as ToolpathRequest, {
      wait: WAIT,
      signal: own.signal,
      onProgress: ({ id, state, progress }) => {
        if (!current()) return;
        job = id;
        activity.value =
          state === "queued"
            ? { words: "Waiting for its turn …", fraction: null }
            : { words: "Planning …", fraction: progress };
      },
    });
    if (current()) job = null;
    await load(asked, report, open, known, own);
  } catch (thrown) {
    if (!current()) return;
    const cancelled = thrown instanceof CancelledError || own.signal.aborted;
    batch(() => {
      activity.value = null;
      trouble.value = cancelled ? "Cancelled." : inWords(thrown);
      faults.value = thrown instanceof ProblemError ? faultsOf(thrown) : [];
    });
  }
}

async function load(
  asked: string,
  report: ToolpathReport,
  open: OpenProgram,
  known: InUse,
  own: AbortController,
): Promise<void> {
  const reading = {
    machine: known,
    signal: own.signal,
    progress: (fraction: number) => {
      if (own === stop) activity.value = { words: "Loading the rows …", fraction };
    },
  };
  const { columns, bucket } = await readRows(report, reading);
  if (own !== stop) return;
  const before = plan.peek();
  batch(() => {
    const lengths = lengthsOf(open, settings.peek(), overTable.peek().tool_radius);
    plan.value = { asked, report, rows: columns, bucket, time: times(columns), lengths };
    activity.value = null;
    // The same program with another set-up stays where it is.
    const end = plan.value.time.at(-1) ?? 0;
    now.value = before?.report.program === report.program ? Math.min(now.peek(), end) : 0;
  });
}

/** The faults of a program among the errors of a problem. */
export function faultsOf({ errors }: ProblemError): Schemas["ProgramFault"][] {
  return errors.flatMap((error) => ("line" in error ? [error] : []));
}

/** The lengths that the tools of a program may have; with the ball's centre as tip, they are shorter by the radius. */
export function lengthsOf({ summary }: OpenProgram, { lengths, tip }: Settings, radius: number): number[] {
  const stated = () => summary.tools.flatMap(({ length }) => (length == null ? [] : [length]));
  const all =
    lengths === "program" ? stated() : typeof lengths === "number" ? [lengths] : Object.values(lengths);
  return [...new Set(all)].map((length) => (tip === "centre" ? length - radius : length));
}
