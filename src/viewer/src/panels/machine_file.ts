/** Reads a machine's file and has the service examine it. */

import { signal } from "@preact/signals";
import { ProblemError, type Machine, type Schemas } from "verne-client";
import { inWords } from "../api/client";
import { takeOwn } from "../state/machines";

/** A file that makes no machine. */
export interface Rejected {
  file: string;
  /** Null where it is not even JSON. */
  content: unknown;
  summary: string;
  /** By pointer into the file. */
  faults: Schemas["FieldProblem"][];
}

export const rejected = signal<Rejected | null>(null);

/** The machine's object is small; a larger file is something else. */
const LARGEST = 64 * 1024;

export async function offer(file: File): Promise<void> {
  rejected.value = null;
  const reject = (summary: string, content: unknown = null, faults: Rejected["faults"] = []) => {
    rejected.value = { file: file.name, content, summary, faults };
  };
  if (file.size > LARGEST) {
    reject(`It has ${file.size} bytes: too large for a machine.`);
    return;
  }
  let content: unknown;
  try {
    content = JSON.parse(await file.text());
  } catch (thrown) {
    reject(`It is not JSON: ${inWords(thrown)}`);
    return;
  }
  if (typeof content !== "object" || content === null || Array.isArray(content)) {
    reject("It is not a machine: a JSON object is expected, as GET /machines/verne shows it.", null);
    return;
  }
  try {
    // What GET /machines/{name} answers holds the machine as `definition`.
    const machine = "definition" in content ? content.definition : content;
    content = machine;
    await takeOwn(machine as Machine);
  } catch (thrown) {
    const faults = thrown instanceof ProblemError ? thrown.errors : [];
    reject(
      inWords(thrown),
      content,
      faults.flatMap((fault) =>
        "pointer" in fault
          ? [{ pointer: fault.pointer.replace(/^\/machine/, ""), detail: fault.detail }]
          : [],
      ),
    );
  }
}

/** Calls with files that are dropped anywhere on the page. */
export function acceptDrops(over: (hovering: boolean) => void, take: (file: File) => void): void {
  addEventListener("dragover", (event) => {
    event.preventDefault();
    over(true);
  });
  addEventListener("dragleave", (event) => {
    if (event.relatedTarget === null) over(false);
  });
  addEventListener("drop", (event) => {
    event.preventDefault();
    over(false);
    const file = event.dataTransfer?.files[0];
    if (file) take(file);
  });
}
