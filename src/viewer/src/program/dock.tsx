/** Below the scene: the time of the program, its plots and its text. */

import { Plots } from "./plots";
import { dockOpen, plan, program } from "./program_state";
import { TextList } from "./text_list";
import { TimeBar, Transport } from "./transport";

export function Dock() {
  if (!program.value) return null;
  const planned = plan.value !== null;
  return (
    <section class={dockOpen.value ? "dock" : "dock closed"} aria-label="Motion of the program">
      {planned && <Transport />}
      {planned && <TimeBar />}
      {dockOpen.value && (
        <div class="beside">
          <TextList />
          {planned && <Plots />}
        </div>
      )}
    </section>
  );
}
