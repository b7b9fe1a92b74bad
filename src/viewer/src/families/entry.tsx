/** The part of the page for families of workspaces. Its code is loaded when the section is opened. */

import { effect, signal } from "@preact/signals";
import { failureOf } from "../api/client";
import { change, failure, view } from "../state/store";

const loaded = signal<typeof import("./family_panel") | null>(null);

async function load(): Promise<void> {
  try {
    loaded.value ??= await import("./family_panel");
  } catch (thrown) {
    failure.value = failureOf(thrown, () => void load());
  }
}

/** Loads the code when the section is opened, by hand or by a link. */
export function keepFamilyPanel(): void {
  effect(() => {
    if (view.value.family.open) void load();
  });
}

export function FamilySection() {
  const Panel = loaded.value?.FamilyPanel;
  const { family } = view.value;
  return (
    <section aria-labelledby="family">
      <details
        open={family.open}
        onToggle={({ currentTarget: { open } }) => change({ family: { ...view.peek().family, open } })}
      >
        <summary>
          <h2 id="family">Volume over tool length or φ₁</h2>
        </summary>
        {Panel ? <Panel /> : <p class="hint">Loading …</p>}
      </details>
    </section>
  );
}
