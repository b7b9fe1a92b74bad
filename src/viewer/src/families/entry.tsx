/** The part of the page for families of workspaces. Its code is loaded when the section is opened. */

import { signal } from "@preact/signals";
import { failureOf } from "../api/client";
import { failure } from "../state/store";

const loaded = signal<typeof import("./family_panel") | null>(null);

async function load(): Promise<void> {
  try {
    loaded.value ??= await import("./family_panel");
  } catch (thrown) {
    failure.value = failureOf(thrown, () => void load());
  }
}

export function FamilySection() {
  const Panel = loaded.value?.FamilyPanel;
  return (
    <section aria-labelledby="family">
      <details onToggle={(event) => event.currentTarget.open && void load()}>
        <summary>
          <h2 id="family">Volume over tool length or φ₁</h2>
        </summary>
        {Panel ? <Panel /> : <p class="hint">Loading …</p>}
      </details>
    </section>
  );
}
