/** Plays the plan: time passes, and the machine follows. */

import { batch, effect, untracked } from "@preact/signals";
import { unwrap } from "verne-client";
import { verne } from "../api/client";
import { latest } from "../api/latest";
import { pass } from "../state/history";
import { moveTo } from "../state/motion";
import { change, machine, overTable, position, refusal, tool } from "../state/store";
import { postureAt, type Posture } from "./posture";
import { currentRow, duration, loop, now, plan, playing, program, shownLine, speed } from "./program_state";
import { instantAt, rowOfLine } from "./timeline";
import { wakeOn } from "./wake_on";

export function play(): void {
  if (!plan.peek()) return;
  if (now.peek() >= duration.peek()) now.value = 0;
  playing.value = true;
}

export function pause(): void {
  playing.value = false;
}

/** Moves the machine to a time, and stops it there. */
export function seek(seconds: number): void {
  playing.value = false;
  now.value = Math.min(Math.max(seconds, 0), duration.peek());
  settle();
}

export function seekRow(row: number): void {
  const time = plan.peek()?.time;
  if (time) seek(time[Math.min(Math.max(row, 0), time.length - 1)] ?? 0);
}

/** Moves the machine to the end of a line's motion. */
export function seekLine(line: number): void {
  const rows = plan.peek()?.rows;
  if (rows) seekRow(rowOfLine(rows, line));
}
/** Moves the machine to a line, or to the last one before it that it reaches; the text shows the line. */
export function showLine(line: number): void {
  seekLine(line);
  shownLine.value = line;
}

/** To the next row, or to the one before. Rows at the same time count as one. */
export function step(direction: 1 | -1): void {
  const time = plan.peek()?.time;
  if (!time) return;
  const at = now.peek();
  let row = currentRow.peek();
  if (direction === 1) row += 1;
  else while (row > 0 && (time[row] ?? 0) >= at) row -= 1;
  seekRow(row);
}

/** Follows the signals. Returns how to end this. */
export function keepPlaying(): () => void {
  const ends = [
    effect(() => (playing.value ? run() : undefined)),
    // A plan shows the machine at its place.
    effect(() => {
      if (plan.value) untracked(settle);
    }),
    effect(() => {
      wakeOn(now);
      if (playing.peek()) untracked(() => show(false));
    }),
  ];
  return () => ends.forEach((end) => end());
}

/** Lets time pass until the end of the effect. */
function run(): () => void {
  let last = performance.now();
  let frame = requestAnimationFrame(tick);
  function tick(moment: number): void {
    const passed = (Math.max(moment - last, 0) / 1000) * speed.peek();
    last = moment;
    const end = duration.peek();
    const next = now.peek() + passed;
    if (next < end) now.value = next;
    else if (loop.peek() && end > 0) now.value = next % end;
    else {
      batch(() => {
        now.value = end;
        playing.value = false;
      });
      return;
    }
    frame = requestAnimationFrame(tick);
  }
  return () => {
    cancelAnimationFrame(frame);
    settle();
  };
}

/** The machine stands: the service says what holds there. */
function settle(): void {
  show(true);
}

function show(stands: boolean): void {
  const [found, known] = [plan.peek(), machine.peek()];
  if (!found || !known || !program.peek() || found.rows.count === 0) return;
  const instant = instantAt(found.time, now.peek());
  const posture = postureAt(found.rows, instant, known.definition, found.lengths);
  pass(posture.joints);
  batch(() => {
    if (tool.peek() !== posture.length) change({ tool: posture.length, joints: posture.joints, mode: null });
    picture(posture);
  });
  if (stands) moveTo({ by: "joints", joints: posture.joints, mode: null });
  else askMargins(posture);
}

/** Draws the machine at once, with the margins that were known last. */
function picture({ joints, platform, tool: end }: Posture): void {
  const before = position.peek();
  if (!before) return;
  position.value = { ...before, joints, solution: { ...before.solution, platform, tool: end } };
  refusal.value = null;
}

/** One question under way while the machine moves: its margins follow a moment later. */
const askMargins = latest<Posture>(async ({ joints, length }) => {
  const body = { machine: machine.peek()?.ref ?? "verne", tool_length: length, joints, ...overTable.peek() };
  const answer = await verne.api.POST("/fk", { body: { ...body, solutions: "working" } }).catch(() => null);
  const found = answer?.data && unwrap(answer).solutions[0];
  const shown = position.peek();
  if (!found || !shown || !playing.peek()) return;
  const { margins, part } = found;
  position.value = { ...shown, solution: { ...shown.solution, margins, ...(part && { part }) } };
});
