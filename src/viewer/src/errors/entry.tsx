/** The part of the page for the errors of the tool. Its code is loaded when the section is opened. */

import { effect, signal } from "@preact/signals";
import { failureOf } from "../api/client";
import type { Stage } from "../scene/stage";
import { change, failure, view } from "../state/store";

const loaded = signal<typeof import("./errors_panel") | null>(null);
const stage = signal<Stage | null>(null);
let loading = false;

/** The scene is there: the surface is drawn in it. */
export function showErrorsIn(scene: Stage): void {
  stage.value = scene;
}

async function load(): Promise<void> {
  if (loading || loaded.value) return;
  loading = true;
  try {
    const module = await import("./errors_panel");
    module.keepSurfaceIn(stage);
    loaded.value = module;
  } catch (thrown) {
    failure.value = failureOf(thrown, () => void load());
  } finally {
    loading = false;
  }
}

/** Loads the code when the section is opened, by hand or by a link. */
export function keepErrorsPanel(): void {
  effect(() => {
    if (view.value.errors.open) void load();
  });
}

export function ErrorsSection() {
  const Panel = loaded.value?.ErrorsPanel;
  const { errors } = view.value;
  return (
    <section aria-labelledby="errors">
      <details
        open={errors.open}
        onToggle={({ currentTarget: { open } }) => change({ errors: { ...view.peek().errors, open } })}
      >
        <summary>
          <h2 id="errors">Errors of the tool</h2>
        </summary>
        {Panel ? <Panel /> : <p class="hint">Loading …</p>}
      </details>
    </section>
  );
}
