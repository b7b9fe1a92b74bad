/** The service, called with the types of its OpenAPI document. */

import createClient from "openapi-fetch";
import type { components, paths } from "../../generated/openapi";
import { send } from "./key";
import { linked } from "./links";

export type Schemas = components["schemas"];
export type Machine = Schemas["Machine"];
export type MachineRef = Schemas["MachineRef"];
export type Solution = Schemas["Solution"];
export type PlatformPose = Schemas["PlatformPose"];
export type Answer = Schemas["Answer"];
export type Limit = Schemas["Limit"];
export type Margins = Schemas["Margins"];
export type Problem = Schemas["Problem"];
export type WorkspaceSummary = Schemas["WorkspaceSummary"];
export type WorkspaceRequest = Schemas["WorkspaceRequest"];
export type WorkspaceKind = Schemas["WorkspaceKind"];
export type Slice = Schemas["Slice"];

/** Relative to the page, so that it also works behind a prefix. */
const BASE = new URL(".", document.baseURI).href.replace(/\/$/, "");

/** The address of a link. It begins with the prefix if the service knows it (--base-path). */
export function address(link: string): string {
  return linked(BASE, link);
}

export const client = createClient<paths>({ baseUrl: BASE, fetch: send });

/** What the service, or the way to it, refused. */
export class Refused extends Error {
  constructor(readonly problem: Pick<Problem, "detail"> & Partial<Problem>) {
    super(problem.detail);
  }
}

/** The data of an answer; its problem is thrown. */
export function unwrap<T>(answer: { data?: T; error?: unknown; response: Response }): T {
  if (answer.data !== undefined) return answer.data;
  throw new Refused(problemOf(answer.error, answer.response));
}

function problemOf(error: unknown, response: Response): Pick<Problem, "detail"> {
  if (typeof error === "object" && error !== null && "detail" in error) return error as Problem;
  return { detail: `The service answered ${response.status} ${response.statusText}.` };
}

/** A failure in words, whatever was thrown. */
export function inWords(thrown: unknown): string {
  if (thrown instanceof Refused) return thrown.message;
  if (thrown instanceof TypeError) return "The service does not answer: is verne still running?";
  return thrown instanceof Error ? thrown.message : String(thrown);
}
