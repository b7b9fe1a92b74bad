/** Dimensions and limits of the machine, changed one by one while it is seen. */

import { signal } from "@preact/signals";
import type { Machine } from "verne-client";
import { failureOf } from "../api/client";
import { fieldFaults, type FieldFaults } from "../api/faults";
import { latest } from "../api/latest";
import { changeMachine } from "./machines";
import { failure, machine } from "./store";

/** The machine with changes that it does not have yet: an answer is awaited, or a value cannot be used. */
export const draft = signal<Machine | null>(null);
/** What is wrong with the draft, by pointer without the leading slash. */
export const draftFaults = signal<FieldFaults>({});

/** Numbers of a machine, each with its pointer. */
export interface NumberLeaf {
  pointer: string;
  value: number;
}

export function numberLeaves(value: unknown, pointer = ""): NumberLeaf[] {
  if (typeof value === "number") return [{ pointer, value }];
  if (typeof value !== "object" || value === null) return [];
  return Object.entries(value).flatMap(([name, item]) =>
    numberLeaves(item, pointer === "" ? name : `${pointer}/${name}`),
  );
}

/** A copy with another number at a pointer. */
export function withNumber(definition: Machine, pointer: string, value: number): Machine {
  const copy = structuredClone(definition);
  const names = pointer.split("/");
  const last = names.pop() ?? "";
  let at = copy as unknown as Record<string, unknown>;
  for (const name of names) at = at[name] as Record<string, unknown>;
  at[last] = value;
  return copy;
}

export function edit(pointer: string, value: number): void {
  const before = draft.peek() ?? machine.peek()?.definition;
  if (!before) return;
  draft.value = withNumber(before, pointer, value);
  send(draft.value);
}

export function discardDraft(): void {
  draft.value = null;
  draftFaults.value = {};
}

const send = latest<Machine>(async (asked) => {
  try {
    await changeMachine(named(asked));
    draftFaults.value = {};
    if (draft.peek() === asked) draft.value = null;
  } catch (thrown) {
    const found = Object.entries(fieldFaults(thrown)).map(([pointer, detail]) => [
      pointer.replace(/^machine\//, ""),
      detail,
    ]);
    draftFaults.value = Object.fromEntries(found) as FieldFaults;
    if (found.length === 0) failure.value = failureOf(thrown, () => send(asked));
  }
});

/** A published machine's name is not that of a changed one. */
function named(asked: Machine): Machine {
  const known = machine.peek();
  const published = typeof known?.ref === "string" && known.ref === asked.name;
  return published
    ? { ...asked, name: `${asked.name}, changed`, description: "Changed on the page." }
    : asked;
}
