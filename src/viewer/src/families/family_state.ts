/** The family that is asked for, and the one that was computed. */

import { batch, computed, effect, signal, untracked } from "@preact/signals";
import { verne } from "../api/client";
import { JobRun } from "../state/job_run";
import { change, machine, overTable, tool, view, wanted, workspaceAngles } from "../state/store";
import type { FamilyParameter, FamilyView, ValueRange } from "../state/view";
import { membersOf, type Member } from "./family_members";
import { familyRequest, faultOf, parametersOf, type Common } from "./family_request";

export interface Family {
  parameter: FamilyParameter;
  common: Common;
  members: Member[];
}

export const run = new JobRun();
const settings = computed(() => view.value.family);
export const ranges = computed(() => settings.value.ranges);
export const family = signal<Family | null>(null);
/** The member that is pointed at: its place in the family. */
export const pointedMember = signal<number | null>(null);

/** The parameter of the next family; null where the workspace depends on none. */
export const parameter = computed(() => {
  const possible = parametersOf(wanted.value.kind);
  const chosen = settings.value.parameter;
  return possible.includes(chosen) ? chosen : (possible[0] ?? null);
});
export const choose = (next: FamilyParameter) => set({ parameter: next });

export function setRange(over: FamilyParameter, part: Partial<ValueRange>): void {
  const before = ranges.peek();
  set({ ranges: { ...before, [over]: { ...before[over], ...part } } });
}

function set(part: Partial<FamilyView>): void {
  change({ family: { ...view.peek().family, ...part } });
}

const common = computed<Common | null>(() => {
  const known = machine.value;
  const angles = workspaceAngles.value;
  if (!known || !angles) return null;
  const { kind, tolerance } = wanted.value;
  return { machine: known.ref, kind, tolerance, toolLength: tool.value, angles, overTable: overTable.value };
});

/** The request as text; null where none is possible. */
const question = computed(() => {
  const over = parameter.value;
  if (!common.value || !over || fault.value) return null;
  return JSON.stringify(familyRequest(common.value, over, ranges.value[over]));
});

export const fault = computed(() => (parameter.value ? faultOf(ranges.value[parameter.value]) : null));

const answered = signal<string | null>(null);
/** Whether the settings have changed since the family was computed. */
export const outdated = computed(() => family.value !== null && answered.value !== question.value);
export const possible = computed(() => question.value !== null);

/** The value of the family's parameter on the page. */
export const current = computed(() => {
  const found = family.value;
  if (!found) return null;
  return found.parameter === "tool_length" ? tool.value : (workspaceAngles.value?.phi1 ?? null);
});

/** Another machine has another family. */
effect(() => {
  if (!machine.value) return;
  untracked(() => {
    run.abandon();
    family.value = null;
  });
});

export async function compute(): Promise<void> {
  const asked = question.peek();
  const over = parameter.peek();
  const settings = common.peek();
  if (asked === null || !over || !settings) return;
  const request = familyRequest(settings, over, ranges.peek()[over]);
  const found = await run.run((wait) => verne.workspace(request, wait));
  if (!found || !("members" in found)) return;
  batch(() => {
    pointedMember.value = null;
    answered.value = asked;
    family.value = { parameter: over, common: settings, members: membersOf(found, over) };
  });
}

/** Shows the workspace of a member: tool and angles become those of the member. */
export function showMember(place: number): void {
  const found = family.peek();
  const member = found?.members[place];
  if (!found || !member) return;
  const { kind, tolerance, angles, toolLength, overTable: table } = found.common;
  const asked = view.peek().workspace;
  const overPhi1 = found.parameter === "phi1";
  const { phi1, phi2 } = { ...angles, ...(overPhi1 && { phi1: member.value }) };
  const now = workspaceAngles.peek();
  const same = now?.phi1 === phi1 && now.phi2 === phi2;
  change({
    tool: overPhi1 ? toolLength : member.value,
    // The other kinds know no table.
    ...(kind === "part" && { clearance: table.table_clearance, radius: table.tool_radius }),
    workspace: { ...asked, shown: true, kind, tolerance, phi1, phi2, follows: asked.follows && same },
  });
}
