/** Long computations: followed over server-sent events, cancelled by DELETE. */

import { EventSourceParserStream } from "eventsource-parser/stream";
import { BASE, Refused } from "./client";
import type { Job } from "./job_types";

/** Follows a job to its end; answers the path of its result. */
export async function follow(
  path: string,
  report: (job: Job) => void,
  signal: AbortSignal,
): Promise<string> {
  const response = await fetch(`${BASE}${path}/events`, {
    headers: { accept: "text/event-stream" },
    signal,
  });
  if (!response.ok || !response.body) {
    throw new Refused({ detail: `The job cannot be followed: ${response.status}.` });
  }
  const events = response.body
    .pipeThrough(new TextDecoderStream())
    .pipeThrough(new EventSourceParserStream());
  for await (const event of events) {
    const job = JSON.parse(event.data) as Job;
    report(job);
    if (job.state === "succeeded" && job.result) return job.result;
    if (job.state === "failed") throw new Refused(job.error ?? { detail: "The job failed." });
    if (job.state === "cancelled") throw new Cancelled();
  }
  throw new Refused({ detail: "The service stopped telling about the job." });
}

export class Cancelled extends Error {}

export async function cancel(path: string): Promise<void> {
  await fetch(`${BASE}${path}`, { method: "DELETE" });
}
