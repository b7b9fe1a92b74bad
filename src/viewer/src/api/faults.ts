/** What the service says about single fields of a request. */

import { ProblemError } from "verne-client";

/** By the field's pointer without its leading slash: `pose/x`. Empty where the failure is of another kind. */
export type FieldFaults = Readonly<Record<string, string>>;

export function fieldFaults(thrown: unknown): FieldFaults {
  if (!(thrown instanceof ProblemError)) return {};
  const entries = thrown.errors.flatMap((fault) =>
    "pointer" in fault ? [[fault.pointer.replace(/^\//, ""), fault.detail] as const] : [],
  );
  return Object.fromEntries(entries);
}
