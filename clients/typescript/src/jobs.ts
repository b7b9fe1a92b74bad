/** Jobs: their events, and the results that they compute. */

import { EventSourceParserStream } from "eventsource-parser/stream";
import { ProblemError, readProblem } from "./problem.js";
import type { Send } from "./retry.js";
import type { Job } from "./schemas.js";

/** How a client watches a computation. */
export interface Watch {
  /** Called with the job at once and at each change of its state or progress. */
  onProgress?: (job: Job) => void;
  /** Ends the wait. The job continues; `cancel` ends it. */
  signal?: AbortSignal;
}

/** The job that should have computed a result was cancelled. */
export class CancelledError extends Error {
  override readonly name = "CancelledError";

  constructor(readonly job: Job) {
    super(`Job ${job.id} was cancelled.`);
  }
}

/** Whether an answer is a job that computes the result, and not the result. */
export function isJob(answer: object): answer is Job {
  return "state" in answer && "links" in answer;
}

/** The states of a job, from the stream of events at this address, until the job has ended. */
export async function* jobEvents(
  send: Send,
  address: string,
  signal?: AbortSignal,
): AsyncGenerator<Job, void> {
  const headers = { accept: "text/event-stream" };
  const response = await send(new Request(address, { headers, signal: signal ?? null }));
  if (!response.ok) throw await readProblem(response);
  if (!response.body) return;
  const decoded = response.body.pipeThrough(new TextDecoderStream());
  const reader = decoded.pipeThrough(new EventSourceParserStream()).getReader();
  try {
    for (;;) {
      const { value, done } = await reader.read();
      if (done) return;
      yield JSON.parse(value.data) as Job;
    }
  } finally {
    await reader.cancel().catch(() => undefined);
  }
}

/** The path of the result of a job that has ended; null if the job has not ended. */
export function resultOf(job: Job): string | null {
  if (job.state === "succeeded" && job.result) return job.result;
  if (job.state === "cancelled") throw new CancelledError(job);
  if (job.state === "failed") {
    throw job.error ? ProblemError.of(job.error) : new ProblemError(500, `Job ${job.id} failed.`, null);
  }
  return null;
}
