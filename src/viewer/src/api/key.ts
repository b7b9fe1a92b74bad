/** The service's key: asked for when the service wants one, kept until the tab is closed. */

import { signal } from "@preact/signals";

/** The service wants a key. */
export interface Wanted {
  /** One was sent that it does not know. */
  refused: boolean;
  /** Goes on with a key, or without one. */
  answer(key: string | null): void;
}

export const wanted = signal<Wanted | null>(null);

const PLACE = "verne-key";

let asking: Promise<boolean> | null = null;

export function hasKey(): boolean {
  return sessionStorage.getItem(PLACE) !== null;
}

/** Sends with the key, and again with the next while the service knows none. */
export async function send(request: Request): Promise<Response> {
  for (;;) {
    const key = sessionStorage.getItem(PLACE);
    const keyed = request.clone();
    if (key !== null) keyed.headers.set("authorization", `Bearer ${key}`);
    const answer = await fetch(keyed);
    if (answer.status !== 401) return answer;
    // Meanwhile another request may have led to a key.
    const same = key === sessionStorage.getItem(PLACE);
    if (same && !(await ask(key !== null))) return answer;
  }
}

/** Asks once for all that wait; whether there is a key now. */
function ask(refused: boolean): Promise<boolean> {
  asking ??= new Promise((resolve) => {
    const answer = (key: string | null) => {
      asking = null;
      wanted.value = null;
      if (key !== null) sessionStorage.setItem(PLACE, key);
      resolve(key !== null);
    };
    wanted.value = { refused, answer };
  });
  return asking;
}
