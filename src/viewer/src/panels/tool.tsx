/** The tool: its length and its end, for the machine and for the workspace. */

import { change, overTable, refusal, tool } from "../state/store";
import { NumberField } from "./fields";
import { SlideField } from "./slide";

/** The tool lengths that the slider offers, mm; longer ones are typed. */
const LONGEST = 400;

export function ToolPanel() {
  return (
    <section aria-labelledby="tool">
      <header>
        <h2 id="tool">Tool</h2>
      </header>
      <SlideField
        label="Tool length"
        symbol="Length"
        unit="mm"
        value={tool.value}
        min={0}
        max={LONGEST}
        most={1e6}
        step={5}
        fault={refusal.value?.fields["tool_length"]}
        commit={(tool) => change({ tool })}
        nudge={(by) => change({ tool: Math.max(0, tool.peek() + by) })}
      />
      <div class="row three">
        <NumberField
          label="Radius of the tool’s end"
          symbol="Radius"
          unit="mm"
          value={overTable.value.tool_radius}
          min={0}
          max={1e6}
          commit={(radius) => change({ radius })}
        />
      </div>
    </section>
  );
}
