/** What the page loads when a program is opened. */

import { effect, type ReadonlySignal } from "@preact/signals";
import type { Stage } from "../scene/stage";
import { forgetWithProgram } from "./inquiry";
import { origins } from "./origins";
import { OriginsRegion } from "./origins_region";
import { placing } from "./placement";
import { keepPlan } from "./planning";
import { keepPlaying } from "./player";
import { keepProgramInView } from "./program_view";
import { PathLines } from "./path_lines";
import { windows } from "./windows";
import "../style/program.css";
import "../style/program_fit.css";

export { Dock } from "./dock";
export { openProgram } from "./open_program";
export { ProgramPanel } from "./program_panel";
export { ReadingDialog } from "./reading_dialog";

/** Follows the signals from now on. */
export function begin(stage: ReadonlySignal<Stage | null>): void {
  keepPlan();
  keepPlaying();
  keepProgramInView();
  forgetWithProgram(placing);
  forgetWithProgram(origins);
  for (const { inquiry } of Object.values(windows)) forgetWithProgram(inquiry);
  effect(() => {
    const scene = stage.value;
    if (!scene) return;
    new PathLines(scene);
    new OriginsRegion(scene);
  });
}
