/** The values of a parameter of the set-up with which the machine can run the program. */

import { computed, type ReadonlySignal } from "@preact/signals";
import type { ToolpathRequest, Window } from "verne-client";
import { verne } from "../api/client";
import { Inquiry } from "./inquiry";
import { question } from "./planning";
import { program, settings } from "./program_state";
import { rangeAround, valueOf, WINDOW_NAMES, withValue, without, type WindowName } from "./window_range";

export interface AskedWindow {
  request: ToolpathRequest;
  parameter: WindowName;
  from: number;
  to: number;
}

interface OneWindow {
  inquiry: Inquiry<Window>;
  /** Whether the window is that of other settings than those in the fields. */
  outdated: ReadonlySignal<boolean>;
}

function oneWindow(name: WindowName): OneWindow {
  const inquiry = new Inquiry<Window>("Looking where it runs …", (asked, options) => {
    const { request, ...range } = JSON.parse(asked) as AskedWindow;
    return verne.window({ ...request, ...range }, options);
  });
  const outdated = computed(() => {
    const [found, now] = [inquiry.found.value, question.value];
    if (!found || now === null) return false;
    const { request } = JSON.parse(found.asked) as AskedWindow;
    return JSON.stringify(without(name, JSON.parse(now) as ToolpathRequest)) !== JSON.stringify(request);
  });
  return { inquiry, outdated };
}

export const windows = Object.fromEntries(WINDOW_NAMES.map((name) => [name, oneWindow(name)])) as Record<
  WindowName,
  OneWindow
>;

/** The value of a parameter now. */
export function valueNow(name: WindowName): number {
  return valueOf(name, settings.value, program.value?.summary.tools[0]?.length ?? null);
}

export function setValue(name: WindowName, value: number): void {
  settings.value = withValue(name, settings.peek(), value);
}

/** Looks for the window of a parameter around its present value. */
export function askWindow(name: WindowName): void {
  const now = question.peek();
  if (now === null) return;
  const asked: AskedWindow = {
    request: without(name, JSON.parse(now) as ToolpathRequest),
    parameter: name,
    ...rangeAround(name, valueNow(name)),
  };
  void windows[name].inquiry.ask(JSON.stringify(asked));
}
