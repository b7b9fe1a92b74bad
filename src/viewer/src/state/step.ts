/** What one step of undo and redo changes. */

import { equal } from "./equal";
import type { ProgramView, View } from "./view";

export type Snapshot = Pick<
  View,
  "machine" | "own" | "joints" | "mode" | "tool" | "radius" | "clearance" | "program"
>;

/** The fields that differ. Steps that change the same fields can be one; a program is opened in a step of its own. */
export function differing(before: Snapshot, next: Snapshot): string {
  const { program: open, ...fields } = before;
  const { program: opened, ...others } = next;
  return [...differingNames(fields, others), ...ofProgram(open, opened)].join();
}

function ofProgram(before: ProgramView | null, next: ProgramView | null): string[] {
  if (before?.id !== next?.id) return [`program ${next?.id ?? "closed"}`];
  if (!before || !next) return [];
  const { settings, ...fields } = before;
  const { settings: others, ...rest } = next;
  const altered = differingNames(settings, others).map((name) => `settings.${name}`);
  return [...differingNames(fields, rest), ...altered].map((name) => `program.${name}`);
}

function differingNames<T extends object>(before: T, next: T): string[] {
  const names = [...new Set([...Object.keys(before), ...Object.keys(next)])] as (keyof T & string)[];
  return names.filter((name) => !equal(before[name], next[name]));
}
