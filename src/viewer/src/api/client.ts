/** The service to which the page belongs. */

import { ProblemError, Verne } from "verne-client";
import { send } from "./key";

/** Relative to the page, so that it also works behind a prefix. */
export const verne = new Verne(new URL(".", document.baseURI).href, { fetch: send });

/** A failure in words, whatever was thrown. */
export function inWords(thrown: unknown): string {
  if (unauthorized(thrown)) return "This service answers only with a key.";
  if (thrown instanceof ProblemError) return thrown.message;
  if (thrown instanceof TypeError) return "The service does not answer: is verne still running?";
  return thrown instanceof Error ? thrown.message : String(thrown);
}

/** What failed, and what the operator can do about it. */
export interface Failure {
  sentence: string;
  remedy: { name: string; apply: () => void } | null;
}

/** A failure in words, with a remedy where the same request can succeed later. */
export function failureOf(thrown: unknown, again: () => void): Failure {
  const later = thrown instanceof TypeError || (thrown instanceof ProblemError && thrown.status >= 500);
  const name = unauthorized(thrown) ? "Enter a key" : later ? "Try again" : null;
  return { sentence: inWords(thrown), remedy: name === null ? null : { name, apply: again } };
}

function unauthorized(thrown: unknown): boolean {
  return thrown instanceof ProblemError && thrown.status === 401;
}
