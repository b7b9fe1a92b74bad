/** Effects that follow signals without their values. */

import type { ReadonlySignal } from "@preact/signals";

/** Reads the signals: the effect that calls this runs again whenever one of them changes. */
export function wakeOn(...signals: ReadonlySignal<unknown>[]): unknown[] {
  return signals.map((signal) => signal.value);
}
