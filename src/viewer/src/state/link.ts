/** Shows what a link asks for. What cannot be shown is replaced, and a notice says so. */

import { failureOf, inWords } from "../api/client";
import { ProblemError } from "verne-client";
import type { Said } from "./address";
import { home, listMachines, loadMachine } from "./machines";
import { arrive } from "./motion";
import { change, failure, followed, machine, notice, view } from "./store";
import { INITIAL, type Joints, type View } from "./view";

/** Letters of an entry that a notice quotes. */
const QUOTED = 40;

export async function follow(said: Said): Promise<void> {
  const notices: string[] = [];
  if (said.unread.length > 0) notices.push(`It contains ${quoted(said.unread)}, which cannot be read.`);
  view.value = said.view;
  try {
    notices.push(...(await takeMachine(said.view)));
    notices.push(...(await takePosition(view.peek())), ...takeCamera());
    failure.value = null;
  } catch (thrown) {
    failure.value = failureOf(thrown, () => {
      void listMachines().catch(() => undefined);
      void follow(said);
    });
  }
  followed.value = true;
  notice.value = notices.length > 0 ? `Not all of the link can be shown. ${notices.join(" ")}` : null;
}

/** The link's machine, or the built-in one at home. */
async function takeMachine(asked: View): Promise<string[]> {
  try {
    await loadMachine(asked);
    return [];
  } catch (thrown) {
    if (!(thrown instanceof ProblemError) || ![404, 422].includes(thrown.status)) throw thrown;
    const name = asked.own ? `own machine “${asked.own.name}”` : `machine “${shortened(asked.machine)}”`;
    change({ machine: INITIAL.machine, own: null, joints: null, mode: null, section: null, camera: null });
    await loadMachine(view.peek());
    return [`Its ${name} is not available: ${inWords(thrown)} The built-in machine stands at home instead.`];
  }
}

/** The link's joints with its tool; where they are impossible, home, and if that is impossible, too, the first tool. */
async function takePosition({ joints }: View): Promise<string[]> {
  const start = joints ?? home();
  if (!start) return [];
  const refused = beyondMachine(start) ?? (await arrive(start));
  if (refused === null) return [];
  change({ joints: null, mode: null, camera: null });
  const atHome = home() ?? start;
  const still = joints && (await arrive(atHome));
  if (joints && still === null)
    return [`Its joints are ${listed(joints)}. ${refused} The machine stands at home instead.`];
  const { tool, radius, clearance } = INITIAL;
  change({ tool, radius, clearance });
  await arrive(atHome);
  return [
    `Its tool cannot be used: ${still ?? refused}. The machine stands at home with a tool of ${tool} mm.`,
  ];
}

/** The link's camera, or the whole machine. */
function takeCamera(): string[] {
  const { camera } = view.peek();
  const g = machine.peek()?.definition.geometry;
  if (!camera || !g) return [];
  const size = (g.L1 + g.L2 + g.L3) / 1000;
  const distance = Math.hypot(...camera.eye.map((at, i) => at - (camera.target[i] ?? 0)));
  const sees =
    distance > 0.02 * size &&
    distance < 12 * size &&
    Math.hypot(...camera.target) < 4 * size &&
    (camera.height ?? size) > 0;
  if (sees) return [];
  change({ camera: null });
  return ["Its camera does not see the machine: all of the machine is shown."];
}

/** Sliders farther from their strokes than legs reach are no position that anyone can see. */
function beyondMachine({ rho }: Joints): string | null {
  const { geometry: g, limits } = machine.peek()?.definition ?? {};
  if (!g || !limits) return null;
  const reach = 2 * Math.max(g.L1, g.L2, g.L3);
  const astray = rho.findIndex((value, i) => {
    const [low = 0, high = 0] = limits.stroke[i] ?? [];
    return value < low - reach || value > high + reach;
  });
  return astray < 0 ? null : `Slider ${astray + 1} would be far outside of the machine.`;
}

function listed({ rho, theta1, theta2 }: Joints): string {
  return [...rho, theta1, theta2].join(", ");
}

function quoted(entries: string[]): string {
  return entries.map((entry) => `“${shortened(entry)}”`).join(", ");
}

function shortened(text: string): string {
  return text.length > QUOTED ? `${text.slice(0, QUOTED)}…` : text;
}
