/** The service to which the page belongs. */

import { ProblemError, Verne } from "verne-client";
import { send } from "./key";

/** Relative to the page, so that it also works behind a prefix. */
export const verne = new Verne(new URL(".", document.baseURI).href, { fetch: send });

/** A failure in words, whatever was thrown. */
export function inWords(thrown: unknown): string {
  if (thrown instanceof ProblemError) return thrown.message;
  if (thrown instanceof TypeError) return "The service does not answer: is verne still running?";
  return thrown instanceof Error ? thrown.message : String(thrown);
}
