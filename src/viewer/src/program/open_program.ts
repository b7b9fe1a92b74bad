/** Sends a program's file to the service, and shows its faults where it has some. */

import { batch, signal } from "@preact/signals";
import { ProblemError, unwrap, type Schemas } from "verne-client";
import { inWords, verne } from "../api/client";
import { view } from "../state/store";
import { formatOf, refusedController, type Format } from "./formats";
import { faultsOf, forgetPlan } from "./planning";
import { activity, program, settings, trouble } from "./program_state";
import { ProgramText, workOffsets } from "./program_text";
import { initialSettings, ORIGIN, type Settings } from "./settings";

/** How the reader takes a file: what the file does not state. */
export interface Reading {
  format: Format | null;
  units: "mm" | "inch" | null;
  /** G-code: control of the tool centre point is always on. */
  tcp: boolean;
  /** G-code: codes that begin and end it, separated by commas. */
  tcpOn: string;
  tcpOff: string;
  /** G-code: feed moves with this feed or a greater one are rapids, mm/min. */
  rapidFeed: number | null;
  rotarySense: "tool" | "table";
}

export const UNREAD: Reading = {
  format: null,
  units: null,
  tcp: false,
  tcpOn: "",
  tcpOff: "",
  rapidFeed: null,
  rotarySense: "tool",
};

/** A file that waits for an answer: its format is not known, or the service refused it. */
export interface Waiting {
  file: File;
  reading: Reading;
  /** Null where only the format is asked for. */
  refusal: { summary: string; faults: Schemas["ProgramFault"][]; text: ProgramText | null } | null;
}

export const waiting = signal<Waiting | null>(null);

/** Sends the file again that the service did not get as a whole; null: there is none. */
export const unsent = signal<(() => void) | null>(null);

/** Bytes from which a file is compressed on its way to another computer: the service waits half a minute for it. */
const LARGE = 4_000_000;
const HERE = /^(localhost|127\.\d+\.\d+\.\d+|\[::1\])$/;

let stop = new AbortController();

/** Opens a file; asks for the format if its name does not tell. */
export async function openProgram(file: File, reading: Reading = UNREAD): Promise<void> {
  const known = { ...reading, format: reading.format ?? formatOf(file.name) };
  const controller = refusedController(file.name);
  if (controller && reading.format === null) {
    const summary = `The service does not read programs for ${controller} controllers. CL text, G-code and tables it does.`;
    waiting.value = { file, reading: known, refusal: { summary, faults: [], text: null } };
    return;
  }
  if (known.format === null) {
    waiting.value = { file, reading: known, refusal: null };
    return;
  }
  waiting.value = null;
  await send(file, known);
}

/** Shows a program that the service keeps, as a link names it. */
export async function openStored(id: string, name: string, wanted: Settings | null): Promise<void> {
  try {
    const summary = unwrap(await verne.api.GET("/programs/{id}", { params: { path: { id } } }));
    const source = await verne.file(summary.links.source);
    // Meanwhile another program may be wanted.
    if (view.peek().program?.id !== id) return;
    show(summary, name, new Uint8Array(source), wanted);
  } catch (thrown) {
    const gone = thrown instanceof ProblemError && thrown.code === "program_not_found";
    trouble.value = gone
      ? "The service no longer keeps the program of this link. Open its file again."
      : inWords(thrown);
  }
}

export function cancelSending(): void {
  stop.abort();
}

async function send(file: File, reading: Reading): Promise<void> {
  const own = new AbortController();
  stop.abort();
  stop = own;
  // What is shown remains until the service has taken the file.
  trouble.value = null;
  unsent.value = null;
  activity.value = { words: `Sending ${file.name} …`, fraction: null };
  try {
    const body = file.size > LARGE && !HERE.test(location.hostname) ? await compressed(file) : file;
    const summary = unwrap(
      await verne.api.POST("/programs", {
        params: { query: query(reading) },
        headers: {
          "content-type": "application/octet-stream",
          ...(body !== file && { "content-encoding": "gzip" }),
        },
        // The file itself, not JSON of it.
        body: body as unknown as string,
        bodySerializer: (whole) => whole,
        signal: own.signal,
      }),
    );
    const bytes = new Uint8Array(await file.arrayBuffer());
    if (own === stop) show(summary, file.name, bytes, null);
  } catch (thrown) {
    if (own === stop) await refused(file, reading, thrown, own.signal.aborted);
  } finally {
    if (own === stop && activity.peek()?.words.startsWith("Sending")) activity.value = null;
  }
}

function compressed(file: File): Promise<Blob> {
  return new Response(file.stream().pipeThrough(new CompressionStream("gzip"))).blob();
}

function show(
  summary: Schemas["ProgramSummary"],
  name: string,
  bytes: Uint8Array,
  wanted: Settings | null,
): void {
  const text = summary.format === "arrow" ? null : new ProgramText(bytes);
  const offsets = text && summary.format === "gcode" ? workOffsets(text) : [];
  const initial = initialSettings(summary.tools, view.peek().tool);
  const named = Object.fromEntries(offsets.map((offset) => [offset, ORIGIN]));
  forgetPlan();
  batch(() => {
    activity.value = null;
    trouble.value = null;
    settings.value = wanted ?? { ...initial, offsets: named };
    program.value = { summary, name, text, offsets };
  });
}

async function refused(file: File, reading: Reading, thrown: unknown, aborted: boolean): Promise<void> {
  if (aborted) {
    trouble.value = "Cancelled.";
    unsent.value = () => void send(file, reading);
    return;
  }
  // Only a file that was read can have faults.
  if (!(thrown instanceof ProblemError) || thrown.status !== 422) {
    trouble.value = inWords(thrown);
    unsent.value = () => void send(file, reading);
    return;
  }
  const faults = faultsOf(thrown);
  const text = faults.length > 0 ? new ProgramText(new Uint8Array(await file.arrayBuffer())) : null;
  waiting.value = { file, reading, refusal: { summary: inWords(thrown), faults, text } };
}

function query(reading: Reading) {
  const { format, units, tcp, tcpOn, tcpOff, rapidFeed, rotarySense } = reading;
  const codes = (text: string) => text.split(/[\s,]+/).filter((code) => code !== "");
  const gcode = format === "gcode";
  return {
    ...(format && { format }),
    ...(units && { units }),
    ...(gcode && tcp && { tcp }),
    ...(gcode && codes(tcpOn).length > 0 && { tcp_on: codes(tcpOn) }),
    ...(gcode && codes(tcpOff).length > 0 && { tcp_off: codes(tcpOff) }),
    ...(gcode && rapidFeed !== null && { rapid_feed: rapidFeed }),
    ...(gcode && rotarySense === "table" && { rotary_sense: rotarySense }),
  };
}
