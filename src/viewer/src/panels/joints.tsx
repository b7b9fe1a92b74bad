/** Five sliders move the machine. */

import { useSignal } from "@preact/signals";
import { jointWays } from "../state/joint_ways";
import { fromList, toList, travels } from "../state/joints";
import { jog, moveTo } from "../state/motion";
import { machine, refusal, wantedJoints } from "../state/store";
import { Choice } from "./fields";
import { Refused } from "./refused";
import { SlideField } from "./slide";

const JOINTS = [
  ["Slider 1", "ρ₁", "mm", "joints/rho/0"],
  ["Slider 2", "ρ₂", "mm", "joints/rho/1"],
  ["Slider 3", "ρ₃", "mm", "joints/rho/2"],
  ["Table tilt", "θ₁", "°", "joints/theta1"],
  ["Table turn", "θ₂", "°", "joints/theta2"],
] as const;

const STEPS = [
  ["0.1", "0.1"],
  ["1", "1"],
  ["10", "10"],
] as const;

export function JointsPanel() {
  const step = useSignal<(typeof STEPS)[number][0]>("1");
  const known = machine.value;
  const wanted = wantedJoints.value;
  if (!known || !wanted) return null;
  const values = toList(wanted);
  const home = toList(known.home.joints);
  const travel = travels(known.definition.limits);
  return (
    <section aria-labelledby="joints">
      <header>
        <h2 id="joints">Joints</h2>
        <button
          type="button"
          class="small"
          onClick={() => moveTo({ by: "joints", joints: known.home.joints, mode: null })}
        >
          Home
        </button>
      </header>
      <Choice
        legend="Step of a key or button, mm or °"
        name="step"
        value={step.value}
        options={STEPS}
        choose={(chosen) => (step.value = chosen)}
      />
      {JOINTS.map(([label, symbol, unit, pointer], i) => {
        const [min, max] = travel[i] ?? [0, 0];
        return (
          <SlideField
            key={symbol}
            label={label}
            symbol={symbol}
            unit={unit}
            value={values[i] ?? 0}
            min={min}
            max={max}
            step={Number(step.value)}
            home={home[i] ?? 0}
            way={jointWays.value?.[i]}
            fault={refusal.value?.fields[pointer]}
            commit={(value) => moveTo({ by: "joints", joints: fromList(values.with(i, value)) })}
            nudge={(by) => jog(i, by)}
          />
        );
      })}
      <Refused by="joints" />
    </section>
  );
}
