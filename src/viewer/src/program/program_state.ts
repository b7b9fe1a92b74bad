/** What the page knows about the program, as signals. */

import { computed, signal } from "@preact/signals";
import type { Schemas, ToolpathReport } from "verne-client";
import { gaps } from "./path_segments";
import { failingTimes } from "./plot_points";
import type { ProgramText } from "./program_text";
import type { RowColumns } from "./row_columns";
import { DEFAULTS, type Settings } from "./settings";
import { lastAtOrBefore } from "./timeline";

/** A program that the service keeps. */
export interface OpenProgram {
  summary: Schemas["ProgramSummary"];
  /** The name of its file. */
  name: string;
  text: ProgramText | null;
  /** The work offsets beside G54 that it calls. */
  offsets: string[];
}

/** What is under way, and how far. */
export interface Activity {
  words: string;
  /** 0 to 1; null where it is not known. */
  fraction: number | null;
}

/** The joint motion of the program. */
export interface Plan {
  /** The question that it answers. */
  asked: string;
  report: ToolpathReport;
  rows: RowColumns;
  /** Consecutive rows of which the page holds the extremes; 1: it holds all. */
  bucket: number;
  /** Seconds from the first row to each row. */
  time: Float64Array;
  /** Lengths that its tools may have, mm. */
  lengths: number[];
}

export const program = signal<OpenProgram | null>(null);
export const settings = signal<Settings>(DEFAULTS);
export const activity = signal<Activity | null>(null);
export const plan = signal<Plan | null>(null);
/** Why there is no plan. */
export const trouble = signal<string | null>(null);
/** The lines that do not fit the set-up, where they are the reason. */
export const faults = signal<Schemas["ProgramFault"][]>([]);
/** The line that the text shows; 0: that of the machine. */
export const shownLine = signal(0);

/** Seconds from the first row to where the machine is shown. */
export const now = signal(0);
export const playing = signal(false);
export const speed = signal(1);
export const loop = signal(false);

/** Whether text and plots are shown below the time. */
export const dockOpen = signal(true);
/** What the plots show of the joints. */
export type Quantity = "position" | "rate";
export const quantity = signal<Quantity>("position");
/** Counts the wishes to see all of the path. */
export const framing = signal(0);

export const duration = computed(() => plan.value?.time.at(-1) ?? 0);
/** The row that the machine stands at or moves from. */
export const currentRow = computed(() => {
  const found = plan.value;
  return found ? Math.max(lastAtOrBefore(found.time, now.value), 0) : 0;
});
/** The line that the machine executes: that of the row to which it moves. */
export const currentLine = computed(() => {
  const found = plan.value;
  if (!found || found.rows.count === 0) return 0;
  const row = currentRow.value;
  const moves = (found.time[row] ?? 0) < now.value;
  return found.rows.line[Math.min(moves ? row + 1 : row, found.rows.count - 1)] ?? 0;
});
/** When a limit is broken, or a place cannot be reached. */
export const failing = computed(() => {
  const found = plan.value;
  if (!found) return [];
  const { time } = found;
  const last = time.length - 1;
  const unreached = gaps(found).map(({ before, after }): [number, number] => [
    time[Math.max(before, 0)] ?? 0,
    time[Math.min(after, last)] ?? 0,
  ]);
  return [...failingTimes(time, found.rows.fraction), ...unreached].sort(([a], [b]) => a - b);
});
