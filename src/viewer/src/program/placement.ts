/** The set-up with the greatest reserve: what may change, how far the limits are to stay away, and the answer. */

import { computed, signal } from "@preact/signals";
import type { Placement, Schemas, ToolpathRequest } from "verne-client";
import { verne } from "../api/client";
import { Inquiry } from "./inquiry";
import { question } from "./planning";
import { settings } from "./program_state";
import { freeOf, reserveOf, type Freedom, type FreeName, type RESERVES } from "./placement_bounds";

export const freedoms = signal<Record<FreeName, Freedom> | null>(null);
/** 0: the limit must hold, without a reserve. */
export const reserves = signal<Record<(typeof RESERVES)[number], number>>({
  stroke: 20,
  slider_joint: 0,
  platform_joint: 0,
  rod_interference: 0,
});

export const placing = new Inquiry<Placement>("Searching for a set-up …", (asked, options) => {
  const { free, reserve, request } = JSON.parse(asked) as Search;
  return verne.placement({ ...request, free, reserve }, options);
});

interface Search {
  request: ToolpathRequest;
  free: Schemas["FreeParameters"];
  reserve: Schemas["Reserve"];
}

/** The tool path's question that is asked now, with the answer's set-up where there is one. */
function placed(request: ToolpathRequest, { setup, tool_length: length }: Placement): ToolpathRequest {
  const longer = typeof request.tool_length === "number" && length != null;
  return { ...request, setup, ...(longer && { tool_length: length }) };
}

/** Whether the answer's set-up is that of the program, the given one is, or the answer is about something else. */
export const standing = computed<"given" | "used" | "outdated" | null>(() => {
  const found = placing.found.value;
  if (!found) return null;
  const { request } = JSON.parse(found.asked) as Search;
  if (question.value === JSON.stringify(placed(request, found.answer))) return "used";
  return question.value === JSON.stringify(request) ? "given" : "outdated";
});

/** The set-up from which the search began. */
export const givenRequest = computed(() => {
  const found = placing.found.value;
  return found ? (JSON.parse(found.asked) as Search).request : null;
});

export function findSetUp(): void {
  const [now, all] = [question.peek(), freedoms.peek()];
  if (now === null || all === null) return;
  const request = JSON.parse(now) as ToolpathRequest;
  const search: Search = {
    request,
    free: freeOf(all, typeof request.tool_length === "number"),
    reserve: reserveOf(reserves.peek()),
  };
  void placing.ask(JSON.stringify(search));
}

/** Takes the set-up that was found; the program is then planned again, and undo leads back. */
export function usePlacement(): void {
  const found = placing.found.peek();
  if (!found) return;
  const { setup, tool_length: length } = found.answer;
  const now = settings.peek();
  settings.value = {
    ...now,
    setup: { ...now.setup, ...setup },
    ...(typeof now.lengths === "number" && length != null && { lengths: length }),
  };
}
