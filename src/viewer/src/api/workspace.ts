/** A workspace's figures: at once where they come quickly, else by a job. */

import { client, unwrap, type Slice, type WorkspaceRequest, type WorkspaceSummary } from "./client";
import { follow, type Job } from "./jobs";

/** Seconds that an answer may take before it becomes a job with a progress bar. */
const WAIT = 1;

export interface Watch {
  /** A job was made, or stands otherwise now. */
  progress(job: Job): void;
  signal: AbortSignal;
}

export async function workspace(body: WorkspaceRequest, watch: Watch): Promise<WorkspaceSummary> {
  const answer = unwrap(
    await client.POST("/workspace", {
      body,
      headers: { accept: "application/json", prefer: `wait=${WAIT}` },
      signal: watch.signal,
    }),
  );
  if (isJob(answer)) {
    watch.progress(answer);
    const result = await follow(answer, (news) => watch.progress(news), watch.signal);
    const id = result.slice(result.lastIndexOf("/") + 1);
    return asSummary(unwrap(await client.GET("/workspace/{id}", { params: { path: { id } } })));
  }
  return asSummary(answer);
}

export async function slice(id: string, z: number): Promise<Slice> {
  const answer = await client.GET("/workspace/{id}/slice", {
    params: { path: { id }, query: { z, format: "json" } },
  });
  return unwrap(answer) as Slice;
}

function isJob(answer: unknown): answer is Job {
  return typeof answer === "object" && answer !== null && "state" in answer;
}

function asSummary(answer: unknown): WorkspaceSummary {
  if (typeof answer === "object" && answer !== null && "volume" in answer) return answer as WorkspaceSummary;
  throw new Error("The service sent something else than the workspace's figures.");
}
