/** A question to the service beside the plan: its progress, its answer, and how it is cancelled. */

import { batch, computed, effect, signal, untracked } from "@preact/signals";
import { CancelledError, ProblemError, type Wait } from "verne-client";
import { inWords, verne } from "../api/client";
import { program, type Activity } from "./program_state";
import { wakeOn } from "./wake_on";

/** Seconds that an answer may take before it becomes a job with a progress bar. */
const WAIT = 1;

/** An answer with the question that it answers. */
export interface Answered<T> {
  asked: string;
  answer: T;
}

export class Inquiry<T> {
  readonly activity = signal<Activity | null>(null);
  /** Why there is no answer. */
  readonly trouble = signal<string | null>(null);
  readonly found = signal<Answered<T> | null>(null);
  private stop = new AbortController();
  private job: string | null = null;

  /** `words` name the work while it lasts; `put` sends the question. */
  constructor(
    private readonly words: string,
    private readonly put: (asked: string, options: Wait) => Promise<T>,
  ) {}

  /** Asks; the question before is abandoned, its answer remains until the new one is there. */
  async ask(asked: string): Promise<void> {
    this.abandon();
    const own = this.stop;
    const current = () => own === this.stop;
    batch(() => {
      this.trouble.value = null;
      this.activity.value = { words: this.words, fraction: null };
    });
    try {
      const answer = await this.put(asked, {
        wait: WAIT,
        signal: own.signal,
        onProgress: ({ id, state, progress }) => {
          if (!current()) return;
          this.job = id;
          this.activity.value =
            state === "queued"
              ? { words: "Waiting for its turn …", fraction: null }
              : { words: this.words, fraction: progress };
        },
      });
      if (!current()) return;
      this.job = null;
      batch(() => {
        this.activity.value = null;
        this.found.value = { asked, answer };
      });
    } catch (thrown) {
      if (!current()) return;
      this.job = null;
      batch(() => {
        this.activity.value = null;
        this.trouble.value =
          thrown instanceof CancelledError || own.signal.aborted ? "Cancelled." : reason(thrown);
      });
    }
  }

  /** Cancels on the operator's word: the answer before remains. */
  cancel(): void {
    this.abandon();
    batch(() => {
      this.activity.value = null;
      this.trouble.value = "Cancelled.";
    });
  }

  /** Nothing is asked and nothing is known. */
  forget(): void {
    this.abandon();
    batch(() => {
      this.activity.value = null;
      this.trouble.value = null;
      this.found.value = null;
    });
  }

  private abandon(): void {
    this.stop.abort();
    if (this.job !== null) void verne.cancel(this.job).catch(() => undefined);
    this.job = null;
    this.stop = new AbortController();
  }
}

/** What was asked about a program is forgotten with it. */
export function forgetWithProgram(inquiry: { forget: () => void }): void {
  const id = computed(() => program.value?.summary.id);
  effect(() => {
    wakeOn(id);
    untracked(() => inquiry.forget());
  });
}

/** A problem with the first line at fault, where it names one. */
function reason(thrown: unknown): string {
  const first = thrown instanceof ProblemError ? thrown.errors[0] : undefined;
  return first ? `${inWords(thrown)} ${first.detail}` : inWords(thrown);
}
