/** The address follows the view, and the view an address that is typed or pasted. */

import { effect } from "@preact/signals";
import { fromAddress, toAddress, type Said } from "./address";
import { view } from "./store";
import type { View } from "./view";

const REST = 250;
let written = "";

export function saidByAddress(): Promise<Said> {
  written = location.hash;
  return fromAddress(location.hash);
}

export function keepAddress(): void {
  effect(() => {
    const now = view.value;
    const timer = setTimeout(() => void write(now), REST);
    return () => clearTimeout(timer);
  });
}

/** Calls when the address changes by another hand. */
export function onNewAddress(follow: (said: Said) => void): void {
  addEventListener("hashchange", () => {
    if (location.hash !== written) void saidByAddress().then(follow);
  });
}

/** The view's address, to send to a colleague. */
export async function link(): Promise<string> {
  return location.href.replace(/#.*/, "") + hash(await toAddress(view.value));
}

async function write(now: View): Promise<void> {
  const words = await toAddress(now);
  if (now !== view.value) return;
  const next = hash(words);
  if (next === written) return;
  written = next;
  history.replaceState(null, "", next || location.pathname + location.search);
}

function hash(words: string): string {
  return words === "" ? "" : `#${words}`;
}
