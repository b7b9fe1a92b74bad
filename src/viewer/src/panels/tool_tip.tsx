/** Where the tool's tip is on the part, to type or to drag. */

import { change, complaint, drag, position, tool } from "../state/store";
import { moveTo } from "../state/motion";
import { degrees, mm, number } from "../words/numbers";
import { Choice, NumberField } from "./fields";

const KEPT = [
  ["part", "angles on the part"],
  ["tool", "the table"],
] as const;

export function ToolTipPanel() {
  const solution = position.value?.solution;
  const part = solution?.part;
  if (!solution || !part) return null;
  const { x, y, z, phi1, phi2 } = part;
  const pose = { x, y, z, phi1, phi2 };
  const { platform } = solution;
  const put = (change: Partial<typeof pose>) => moveTo({ by: "part", pose: { ...pose, ...change } });
  const trouble = complaint.value;
  return (
    <section aria-labelledby="tip">
      <header>
        <h2 id="tip">Tool tip on the part</h2>
      </header>
      <div class="row three">
        <NumberField label="X on the part" symbol="X" unit="mm" value={x} commit={(x) => put({ x })} />
        <NumberField label="Y on the part" symbol="Y" unit="mm" value={y} commit={(y) => put({ y })} />
        <NumberField label="Z above the table" symbol="Z" unit="mm" value={z} commit={(z) => put({ z })} />
      </div>
      <div class="row three">
        <NumberField
          label="Inclination phi 1"
          symbol="φ₁"
          unit="°"
          value={phi1}
          commit={(phi1) => put({ phi1 })}
        />
        <NumberField
          label="Azimuth phi 2"
          symbol="φ₂"
          unit="°"
          value={phi2}
          commit={(phi2) => put({ phi2 })}
        />
        <NumberField
          label="Tool length"
          symbol="Tool"
          unit="mm"
          value={tool.value}
          min={0}
          max={1e6}
          commit={(tool) => change({ tool })}
        />
      </div>
      <p role="status" class={trouble ? "trouble" : "hint"} data-testid="trouble">
        {trouble ? trouble.sentence : "Drag the arrows at the tip, or type."}
      </p>
      <Choice
        legend="Dragging keeps"
        name="drag"
        value={drag.value}
        options={KEPT}
        choose={(drag) => change({ drag })}
      />
      <dl class="figures">
        <dt>Platform x, y, z</dt>
        <dd>
          {number(platform.x)}, {number(platform.y)}, {mm(platform.z)}
        </dd>
        <dt>Platform tilt α</dt>
        <dd>{degrees(platform.alpha, 2)}</dd>
      </dl>
    </section>
  );
}
