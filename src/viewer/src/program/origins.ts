/** The region of origins: where the origin of the set-up may be, with all else as it is. */

import { computed, signal } from "@preact/signals";
import type { OriginsSummary, ToolpathRequest } from "verne-client";
import { verne } from "../api/client";
import { Inquiry } from "./inquiry";
import { question } from "./planning";

/** Step of the grid from which the surface is made, mm. */
export const cell = signal(40);

interface AskedRegion {
  request: ToolpathRequest;
  cell: number;
}

export const origins = new Inquiry<OriginsSummary>("Computing the region of origins …", (asked, options) => {
  const { request, cell } = JSON.parse(asked) as AskedRegion;
  return verne.origins({ ...request, cell }, options);
});

/** Requests that differ in the origin alone have the same region. */
function withoutOrigin(asked: string): ToolpathRequest {
  const request = JSON.parse(asked) as ToolpathRequest;
  return { ...request, setup: { ...request.setup, x: 0, y: 0, z: 0 } };
}

/** Whether the region is that of other settings than those in the fields. */
export const regionOutdated = computed(() => {
  const [found, now] = [origins.found.value, question.value];
  if (!found || now === null) return false;
  const { request } = JSON.parse(found.asked) as AskedRegion;
  return JSON.stringify(withoutOrigin(now)) !== JSON.stringify(request);
});

export function askRegion(): void {
  const now = question.peek();
  if (now === null) return;
  const asked: AskedRegion = { request: withoutOrigin(now), cell: cell.peek() };
  void origins.ask(JSON.stringify(asked));
}
