/** The joints in the colours of their lines, with their values where the machine is. */

import { currentRow, now, plan, quantity, type Quantity } from "./program_state";
import { JOINTS } from "./row_columns";
import { instantAt, jointsAt } from "./timeline";
import { number } from "../words/numbers";

const SYMBOLS = ["ρ₁", "ρ₂", "ρ₃", "θ₁", "θ₂"];

export function JointLegend() {
  const found = plan.value;
  if (!found) return null;
  const rate = quantity.value === "rate";
  const { rows, time } = found;
  const joints = jointsAt(rows, instantAt(time, now.value));
  const row = Math.min(currentRow.value + 1, rows.count - 1);
  const passed = (time[row] ?? 0) - (time[row - 1] ?? 0);
  return (
    <>
      <select
        aria-label="The joints’"
        value={quantity.value}
        onChange={(event) => (quantity.value = event.currentTarget.value as Quantity)}
      >
        <option value="position">Joints: position</option>
        <option value="rate">Joints: rate</option>
      </select>
      <ul class="joint-legend" aria-label="Joints">
        {JOINTS.map((joint, i) => {
          const way = (rows.joints[joint][row] ?? 0) - (rows.joints[joint][row - 1] ?? 0);
          const value = rate ? (passed > 0 ? way / passed : 0) : joints[joint];
          const unit = `${i < 3 ? " mm" : "°"}${rate ? "/s" : ""}`;
          return (
            <li key={joint}>
              <svg viewBox="0 0 18 6" aria-hidden="true">
                <line x1="0" x2="18" y1="3" y2="3" class={`joint-${i + 1}`} />
              </svg>
              {SYMBOLS[i]} {number(value, 1)}
              {unit}
            </li>
          );
        })}
      </ul>
    </>
  );
}
