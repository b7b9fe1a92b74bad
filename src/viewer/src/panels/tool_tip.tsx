/** Where the tool's tip is on the part, to type or to drag. */

import { change, drag, heading, position, refusal } from "../state/store";
import type { PartPose, Target } from "../state/target";
import { moveTo } from "../state/motion";
import { degrees, mm, number } from "../words/numbers";
import { tooltip } from "../words/symbols";
import { Choice, NumberField } from "./fields";
import { Refused } from "./refused";

const KEPT = [
  ["part", "angles on the part"],
  ["tool", "the table"],
] as const;

const FIELDS = [
  ["x", "X on the part", "X", "mm"],
  ["y", "Y on the part", "Y", "mm"],
  ["z", "Z above the table", "Z", "mm"],
  ["phi1", "Inclination phi 1", "φ₁", "°"],
  ["phi2", "Azimuth phi 2", "φ₂", "°"],
] as const;
type Field = (typeof FIELDS)[number];

export function ToolTipPanel() {
  const solution = position.value?.solution;
  const part = solution?.part;
  if (!solution || !part) return null;
  const refused = refusal.value;
  const known: PartPose = { x: part.x, y: part.y, z: part.z, phi1: part.phi1, phi2: part.phi2 };
  // A pose that cannot be reached stays in its fields.
  const pose = posed(heading.value) ?? posed(refused?.target) ?? known;
  const { platform } = solution;
  /** Only a field whose value is not where the machine stands can be at fault. */
  const fault = (name: Field[0]) => {
    if (!refused || posed(refused.target) !== pose || pose[name] === known[name]) return undefined;
    return refused.fields[`pose/${name}`] ?? "";
  };
  const field = ([name, label, symbol, unit]: Field) => (
    <NumberField
      key={name}
      label={label}
      symbol={symbol}
      unit={unit}
      value={pose[name]}
      fault={fault(name)}
      commit={(value) => moveTo({ by: "part", pose: { ...pose, [name]: value } })}
    />
  );
  return (
    <section aria-labelledby="tip">
      <header>
        <h2 id="tip">Tool tip on the part</h2>
      </header>
      <div class="row three">{FIELDS.slice(0, 3).map(field)}</div>
      <div class="row three">{FIELDS.slice(3).map(field)}</div>
      <Refused by="pose">Drag the arrows or the knobs at the tip, or type.</Refused>
      <Choice
        legend="Dragging keeps"
        name="drag"
        value={drag.value}
        options={KEPT}
        choose={(drag) => change({ drag })}
      />
      <dl class="figures">
        <dt title={tooltip("x")}>Platform x, y, z</dt>
        <dd>
          {number(platform.x)}, {number(platform.y)}, {mm(platform.z)}
        </dd>
        <dt title={tooltip("α")}>Platform tilt α</dt>
        <dd>{degrees(platform.alpha, 2)}</dd>
      </dl>
    </section>
  );
}

function posed(target: Target | null | undefined): PartPose | null {
  return target?.by === "part" ? target.pose : null;
}
