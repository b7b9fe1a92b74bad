/** The part of the page for the map of solutions. Its code is loaded when the section is opened. */

import { effect, signal } from "@preact/signals";
import { failureOf } from "../api/client";
import { change, failure, view } from "../state/store";

const loaded = signal<typeof import("./atlas_panel") | null>(null);

async function load(): Promise<void> {
  try {
    loaded.value ??= await import("./atlas_panel");
  } catch (thrown) {
    failure.value = failureOf(thrown, () => void load());
  }
}

/** Loads the code when the section is opened, by hand or by a link. */
export function keepAtlasPanel(): void {
  effect(() => {
    if (view.value.atlas.open) void load();
  });
}

export function AtlasSection() {
  const Panel = loaded.value?.AtlasPanel;
  const { atlas } = view.value;
  return (
    <section aria-labelledby="atlas">
      <details
        open={atlas.open}
        onToggle={({ currentTarget: { open } }) => change({ atlas: { ...view.peek().atlas, open } })}
      >
        <summary>
          <h2 id="atlas">Map of solutions</h2>
        </summary>
        {Panel ? <Panel /> : <p class="hint">Loading …</p>}
      </details>
    </section>
  );
}
