/** Undo and redo, measuring, and the scene as a picture. */

import { inWords } from "../api/client";
import type { World } from "../scene/world";
import { canRedo, canUndo, redo, undo } from "../state/history";
import { measuring, toggleMeasuring } from "../state/measurement";
import { failure, machine } from "../state/store";
import { saveFile } from "./save_file";

export function SceneTools({ world }: { world: World | null }) {
  const picture = async () => {
    try {
      if (world) saveFile(await world.picture(), `${machine.peek()?.definition.name ?? "verne"}.png`);
    } catch (thrown) {
      failure.value = { sentence: inWords(thrown), remedy: null };
    }
  };
  return (
    <div role="group" aria-label="Steps, measuring, picture">
      <button type="button" title="Undo (Ctrl+Z)" disabled={!canUndo.value} onClick={undo}>
        Undo
      </button>
      <button type="button" title="Redo (Ctrl+Shift+Z)" disabled={!canRedo.value} onClick={redo}>
        Redo
      </button>
      <button
        type="button"
        title="The distance between two points that you click"
        aria-pressed={measuring.value}
        disabled={!world}
        onClick={toggleMeasuring}
      >
        Measure
      </button>
      <button
        type="button"
        title="Save the scene as a PNG file"
        disabled={!world}
        onClick={() => void picture()}
      >
        Picture
      </button>
    </div>
  );
}
