/** A workspace's figures: at once where they come quickly, else by a job. */

import { client, unwrap, type Slice, type WorkspaceRequest, type WorkspaceSummary } from "./client";
import { follow } from "./jobs";
import type { Job } from "./job_types";

/** Seconds that an answer may take before it becomes a job with a progress bar. */
const WAIT = 1;

export interface Watch {
  /** A job was made; its path. */
  queued(path: string): void;
  progress(job: Job): void;
  signal: AbortSignal;
}

export async function workspace(body: WorkspaceRequest, watch: Watch): Promise<WorkspaceSummary> {
  const answer = await client.POST("/workspace", {
    body,
    headers: { accept: "application/json", prefer: `wait=${WAIT}` },
    signal: watch.signal,
  });
  const job = answer.response.status === 202 ? answer.response.headers.get("location") : null;
  if (job === null) return asSummary(unwrap<unknown>(answer));
  watch.queued(job);
  const result = await follow(job, (news) => watch.progress(news), watch.signal);
  const id = result.slice(result.lastIndexOf("/") + 1);
  return unwrap(await client.GET("/workspace/{id}", { params: { path: { id } } }));
}

function asSummary(answer: unknown): WorkspaceSummary {
  if (typeof answer === "object" && answer !== null && "id" in answer) return answer as WorkspaceSummary;
  throw new Error("The service sent a mesh where a summary was asked for.");
}

export async function slice(id: string, z: number): Promise<Slice> {
  const answer = await client.GET("/workspace/{id}/slice", {
    params: { path: { id }, query: { z, format: "json" } },
  });
  return unwrap(answer) as Slice;
}
