/** Asks what may change of the set-up, and how far from the limits the program is to stay. */

import { NumberField } from "../panels/fields";
import { findSetUp, freedoms, placing, reserves } from "./placement";
import { FREE_NAMES, RESERVES, type FreeName } from "./placement_bounds";
import { settings } from "./program_state";

const NAMES: Record<FreeName, string> = {
  "setup.x": "X",
  "setup.y": "Y",
  "setup.z": "Z",
  "setup.c": "C",
  tool_length: "Tool",
};
const SPOKEN: Record<FreeName, string> = {
  "setup.x": "x of the set-up",
  "setup.y": "y of the set-up",
  "setup.z": "z of the set-up",
  "setup.c": "turn about z",
  tool_length: "length of the tool",
};
const RESERVE_FIELDS: Record<(typeof RESERVES)[number], { label: string; unit: string }> = {
  stroke: { label: "from the ends of the sliders", unit: "mm" },
  slider_joint: { label: "of the joints at the sliders", unit: "°" },
  platform_joint: { label: "of the joints at the platform", unit: "°" },
  rod_interference: { label: "between rods", unit: "mm" },
};

export function PlacementForm() {
  const all = freedoms.value;
  if (!all) return null;
  const oneLength = typeof settings.value.lengths === "number";
  const usable = FREE_NAMES.filter((name) => name !== "tool_length" || oneLength);
  const nothing = !usable.some((name) => all[name].free);
  const without = RESERVES.every((name) => reserves.value[name] <= 0);
  return (
    <form
      class="placement-form"
      onSubmit={(event) => {
        event.preventDefault();
        findSetUp();
      }}
    >
      <fieldset class="offset">
        <legend class="quiet">May change, within these bounds</legend>
        {usable.map((name) => (
          <Freedom key={name} name={name} />
        ))}
        {!oneLength && <p class="hint">With one length for all tools, the length may change too.</p>}
      </fieldset>
      <fieldset class="offset">
        <legend class="quiet">Distance to keep (0: the limit must only hold)</legend>
        {RESERVES.map((name) => (
          <Reserve key={name} name={name} />
        ))}
      </fieldset>
      {nothing && <p class="hint">Choose something that may change.</p>}
      {without && <p class="hint">State a distance that is greater than 0.</p>}
      <p class="row">
        <button type="submit" disabled={nothing || without || placing.activity.value !== null}>
          Search
        </button>
      </p>
    </form>
  );
}

function Freedom({ name }: { name: FreeName }) {
  const all = freedoms.value;
  if (!all) return null;
  const now = all[name];
  const unit = name === "setup.c" ? "°" : "mm";
  const alter = (part: Partial<typeof now>) => (freedoms.value = { ...all, [name]: { ...now, ...part } });
  const shared = { unit, decimals: 1, step: 10 };
  const least = name === "tool_length" ? 0 : -Infinity;
  return (
    <div class="freedom">
      <label class="check">
        <input
          type="checkbox"
          aria-label={`The ${SPOKEN[name]} may change`}
          checked={now.free}
          onChange={(event) => alter({ free: event.currentTarget.checked })}
        />
        {NAMES[name]}
      </label>
      {now.free && (
        <>
          <NumberField
            {...shared}
            label={`Least ${SPOKEN[name]}`}
            symbol="from"
            value={now.from}
            min={least}
            max={now.to}
            commit={(from) => alter({ from })}
          />
          <NumberField
            {...shared}
            label={`Greatest ${SPOKEN[name]}`}
            symbol="to"
            value={now.to}
            min={now.from}
            commit={(to) => alter({ to })}
          />
        </>
      )}
    </div>
  );
}

function Reserve({ name }: { name: (typeof RESERVES)[number] }) {
  const { label, unit } = RESERVE_FIELDS[name];
  return (
    <div class="reserve">
      <NumberField
        label={`Distance ${label}`}
        symbol={label}
        unit={unit}
        value={reserves.value[name]}
        decimals={1}
        min={0}
        step={5}
        commit={(value) => (reserves.value = { ...reserves.value, [name]: value })}
      />
    </div>
  );
}
