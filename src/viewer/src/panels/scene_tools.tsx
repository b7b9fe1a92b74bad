/** What is done to the whole: one step back, one step forth. */

import { canRedo, canUndo, redo, undo } from "../state/history";

export function SceneTools() {
  return (
    <div class="tools" role="group" aria-label="Undo and redo">
      <button type="button" title="Undo (Ctrl+Z)" disabled={!canUndo.value} onClick={undo}>
        Undo
      </button>
      <button type="button" title="Redo (Ctrl+Shift+Z)" disabled={!canRedo.value} onClick={redo}>
        Redo
      </button>
    </div>
  );
}
