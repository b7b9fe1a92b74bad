/** The part of the page for dexterity maps. Its code is loaded when the section is opened. */

import { effect, signal } from "@preact/signals";
import { failureOf } from "../api/client";
import type { Stage } from "../scene/stage";
import { change, failure, view } from "../state/store";

const loaded = signal<typeof import("./dexterity_panel") | null>(null);
const stage = signal<Stage | null>(null);
let loading = false;

/** The scene is there: the layers are drawn in it. */
export function showLayersIn(scene: Stage): void {
  stage.value = scene;
}

async function load(): Promise<void> {
  if (loading || loaded.value) return;
  loading = true;
  try {
    const module = await import("./dexterity_panel");
    module.keepLayersIn(stage);
    loaded.value = module;
  } catch (thrown) {
    failure.value = failureOf(thrown, () => void load());
  } finally {
    loading = false;
  }
}

/** Loads the code when the section is opened, by hand or by a link. */
export function keepDexterityPanel(): void {
  effect(() => {
    if (view.value.dexterity.open) void load();
  });
}

export function DexteritySection() {
  const Panel = loaded.value?.DexterityPanel;
  const { dexterity } = view.value;
  return (
    <section aria-labelledby="dexterity">
      <details
        open={dexterity.open}
        onToggle={({ currentTarget: { open } }) => change({ dexterity: { ...view.peek().dexterity, open } })}
      >
        <summary>
          <h2 id="dexterity">Dexterity map</h2>
        </summary>
        {Panel ? <Panel /> : <p class="hint">Loading …</p>}
      </details>
    </section>
  );
}

/** Over the scene: of which settings the map is. */
export function DexterityCaption() {
  const Caption = loaded.value?.MapCaption;
  return Caption ? <Caption /> : null;
}
