/** One computation at a time for a panel: its progress, its cancellation, and a sentence about its end. */

import { batch, signal } from "@preact/signals";
import { CancelledError, type Wait } from "verne-client";
import { inWords, verne } from "../api/client";
import type { Computing } from "./store";

/** Seconds that an answer may take before it becomes a job with a progress bar. */
const WAIT = 1;

export class JobRun {
  readonly computing = signal<Computing | null>(null);
  /** Why the last computation has no result. */
  readonly note = signal<string | null>(null);
  private stop = new AbortController();

  /** The answer; null if the computation failed, was cancelled, or another one replaced it. */
  async run<T>(ask: (wait: Wait) => Promise<T>): Promise<T | null> {
    this.abandon();
    const own = (this.stop = new AbortController());
    batch(() => {
      this.computing.value = { progress: null, state: "waiting", job: null };
      this.note.value = null;
    });
    try {
      const found = await ask({
        wait: WAIT,
        signal: own.signal,
        onProgress: ({ id, state, progress }) => {
          if (own !== this.stop) return;
          this.computing.value = { progress, state: state === "queued" ? "queued" : "running", job: id };
        },
      });
      if (own !== this.stop) return null;
      this.computing.value = null;
      return found;
    } catch (thrown) {
      if (own !== this.stop) return null;
      const cancelled = thrown instanceof CancelledError || own.signal.aborted;
      batch(() => {
        this.note.value = cancelled ? "Cancelled." : inWords(thrown);
        this.computing.value = null;
      });
      return null;
    }
  }

  /** Cancels on the operator's word. */
  async cancel(): Promise<void> {
    const job = this.computing.peek()?.job;
    if (!job) this.stop.abort();
    else await verne.cancel(job).catch((thrown: unknown) => (this.note.value = inWords(thrown)));
  }

  /** Ends a computation whose result nobody waits for. */
  abandon(): void {
    const job = this.computing.peek()?.job;
    this.stop.abort();
    this.stop = new AbortController();
    if (job) void verne.cancel(job).catch(() => undefined);
    this.computing.value = null;
  }
}
