/** Long computations: followed over server-sent events, cancelled by DELETE. */

import { EventSourceParserStream } from "eventsource-parser/stream";
import { address, client, Refused, unwrap, type Schemas } from "./client";
import { send } from "./key";

export type Job = Schemas["Job"];

/** Follows a job to its end; answers the path of its result. */
export async function follow(started: Job, report: (job: Job) => void, signal: AbortSignal): Promise<string> {
  const headers = { accept: "text/event-stream" };
  const response = await send(new Request(address(started.links.events), { headers, signal }));
  if (!response.ok || !response.body) {
    throw new Refused({ detail: `The job cannot be followed: ${response.status}.` });
  }
  const events = response.body
    .pipeThrough(new TextDecoderStream())
    .pipeThrough(new EventSourceParserStream());
  const reader = events.getReader();
  for (;;) {
    const { value, done } = await reader.read();
    if (done) throw new Refused({ detail: "The service stopped telling about the job." });
    const job = JSON.parse(value.data) as Job;
    report(job);
    if (job.state === "succeeded" && job.result) return job.result;
    if (job.state === "failed") throw new Refused(job.error ?? { detail: "The job failed." });
    if (job.state === "cancelled") throw new Cancelled();
  }
}

export class Cancelled extends Error {}

export async function cancel(id: string): Promise<void> {
  unwrap(await client.DELETE("/jobs/{id}", { params: { path: { id } } }));
}
