/** The program in the view, and so in the link: its id, the name of its file, and what differs from the defaults. */

import { effect } from "@preact/signals";
import { change, tool, view } from "../state/store";
import { openStored } from "./open_program";
import { program, settings } from "./program_state";
import { DEFAULTS, type Settings } from "./settings";

export function keepProgramInView(): void {
  effect(() => {
    const open = program.value;
    if (!open) return;
    const { summary, name } = open;
    change({ program: { id: summary.id, name, settings: differing(settings.value) } });
  });
  // One length for all tools is that of the tool on the page.
  effect(() => {
    const length = tool.value;
    const { lengths, tip } = settings.peek();
    if (program.peek() && typeof lengths === "number" && tip === "end" && lengths !== length)
      settings.value = { ...settings.peek(), lengths: length };
  });
  effect(() => {
    const wanted = view.value.program;
    if (!wanted || wanted.id === program.peek()?.summary.id) return;
    void openStored(wanted.id, wanted.name, { ...DEFAULTS, ...wanted.settings });
  });
}

/** The settings that are not the defaults. */
export function differing(now: Settings): Partial<Settings> {
  const same = (a: unknown, b: unknown) => JSON.stringify(a) === JSON.stringify(b);
  const names = Object.keys(DEFAULTS) as (keyof Settings)[];
  return Object.fromEntries(
    names.filter((name) => !same(now[name], DEFAULTS[name])).map((name) => [name, now[name]]),
  );
}
