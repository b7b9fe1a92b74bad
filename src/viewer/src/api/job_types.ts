/** The jobs' wire types, until the OpenAPI document has them. */

import type { Problem } from "./client";

export interface Job {
  id: string;
  state: "queued" | "running" | "succeeded" | "failed" | "cancelled";
  progress?: number | null;
  result?: string | null;
  error?: Problem | null;
}
