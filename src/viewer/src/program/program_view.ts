/** The program in the view, and so in the link: its id, the name of its file, and what differs from the defaults. */

import { batch, computed, effect, untracked } from "@preact/signals";
import { equal } from "../state/equal";
import { change, tool, view } from "../state/store";
import type { ProgramView } from "../state/view";
import { openStored } from "./open_program";
import { forgetPlan } from "./planning";
import { faults, program, settings, trouble } from "./program_state";
import { DEFAULTS, type Settings } from "./settings";

/** Other changes of the view leave it the same. */
const inView = computed(() => view.value.program);

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
    const wanted = inView.value;
    untracked(() => follow(wanted));
  });
}

/** Shows the program of the view: undo, redo and links change it. */
function follow(wanted: ProgramView | null): void {
  const open = program.peek();
  if (!wanted) {
    if (open) close();
    return;
  }
  const wished = { ...DEFAULTS, ...wanted.settings };
  if (wanted.id !== open?.summary.id) void openStored(wanted.id, wanted.name, wished);
  else if (!equal(wished, settings.peek())) settings.value = wished;
}

function close(): void {
  forgetPlan();
  batch(() => {
    program.value = null;
    trouble.value = null;
    faults.value = [];
  });
}

/** The settings that are not the defaults. */
export function differing(now: Settings): Partial<Settings> {
  const names = Object.keys(DEFAULTS) as (keyof Settings)[];
  return Object.fromEntries(
    names.filter((name) => !equal(now[name], DEFAULTS[name])).map((name) => [name, now[name]]),
  );
}
