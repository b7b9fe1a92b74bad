/** Five sliders move the machine. */

import { heading, machine, position, refusal } from "../state/store";
import { moveTo } from "../state/motion";
import type { Joints } from "../state/view";
import { SlideField } from "./fields";

export function JointsPanel() {
  const known = machine.value;
  const target = heading.value ?? refusal.value?.target;
  const wanted = (target?.by === "joints" ? target.joints : position.value?.joints) ?? known?.home.joints;
  if (!known || !wanted) return null;
  const { limits } = known.definition;
  const move = (joints: Joints) => moveTo({ by: "joints", joints });
  const rho = (i: 0 | 1 | 2, value: number) => {
    const next: Joints["rho"] = [...wanted.rho];
    next[i] = value;
    move({ ...wanted, rho: next });
  };
  return (
    <section aria-labelledby="joints">
      <header>
        <h2 id="joints">Joints</h2>
        <span class="quiet">ρ points down, as z</span>
        <button
          type="button"
          class="small"
          onClick={() => moveTo({ by: "joints", joints: known.home.joints, mode: null })}
        >
          Home
        </button>
      </header>
      {([0, 1, 2] as const).map((i) => {
        const [min = 0, max = 0] = limits.stroke[i] ?? [];
        return (
          <SlideField
            key={i}
            label={`Slider ${i + 1}`}
            symbol={`ρ${"₁₂₃"[i]}`}
            unit="mm"
            value={wanted.rho[i]}
            min={min}
            max={max}
            commit={(value) => rho(i, value)}
          />
        );
      })}
      <SlideField
        label="Table tilt"
        symbol="θ₁"
        unit="°"
        value={wanted.theta1}
        min={limits.tilt[0] ?? -90}
        max={limits.tilt[1] ?? 90}
        step={0.5}
        commit={(theta1) => move({ ...wanted, theta1 })}
      />
      <SlideField
        label="Table turn"
        symbol="θ₂"
        unit="°"
        value={wanted.theta2}
        min={limits.rotary?.[0] ?? -360}
        max={limits.rotary?.[1] ?? 360}
        step={0.5}
        commit={(theta2) => move({ ...wanted, theta2 })}
      />
    </section>
  );
}
