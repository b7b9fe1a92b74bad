/** The part of the page for programs. Its code is loaded when a program is opened. */

import { effect, signal } from "@preact/signals";
import { failureOf } from "../api/client";
import type { Stage } from "../scene/stage";
import { failure, view } from "../state/store";
import { ACCEPTED } from "./formats";

type Loaded = typeof import("./program");

const loaded = signal<Loaded | null>(null);
const stage = signal<Stage | null>(null);
let loading: Promise<Loaded> | null = null;

function load(): Promise<Loaded> {
  loading ??= import("./program").then(
    (module) => {
      module.begin(stage);
      loaded.value = module;
      return module;
    },
    (thrown: unknown) => {
      // The next attempt asks the service again.
      loading = null;
      throw thrown;
    },
  );
  return loading;
}

/** The scene is there: the path is drawn in it. */
export function showPathIn(scene: Stage): void {
  stage.value = scene;
}

/** Opens the file of a program. */
export async function openProgramFile(file: File): Promise<void> {
  try {
    await (await load()).openProgram(file);
  } catch (thrown) {
    failure.value = failureOf(thrown, () => void openProgramFile(file));
  }
}

/** Opens the programs that links name. */
export function followLinks(): void {
  effect(() => {
    if (view.value.program) void loadForLink();
  });
}

async function loadForLink(): Promise<void> {
  try {
    await load();
  } catch (thrown) {
    failure.value = failureOf(thrown, () => void loadForLink());
  }
}

export function ProgramSection() {
  const Panel = loaded.value?.ProgramPanel;
  return (
    <section aria-labelledby="program">
      <header>
        <h2 id="program">Program</h2>
        <OpenProgram />
      </header>
      {Panel ? <Panel /> : <p class="hint">CL text, G-code or a table of points; or drop it on the page.</p>}
    </section>
  );
}

function OpenProgram() {
  return (
    <label class="button small">
      Open program …
      <input
        type="file"
        aria-label="Open a program"
        accept={ACCEPTED}
        onChange={(event) => {
          const file = event.currentTarget.files?.[0];
          if (file) void openProgramFile(file);
          event.currentTarget.value = "";
        }}
      />
    </label>
  );
}

/** Time line, plots and text, below the scene. */
export function ProgramDock() {
  const Dock = loaded.value?.Dock;
  return Dock ? <Dock /> : null;
}

/** Dialogs about files that the service cannot read as they are. */
export function ProgramDialogs() {
  const Dialog = loaded.value?.ReadingDialog;
  return Dialog ? <Dialog /> : null;
}
