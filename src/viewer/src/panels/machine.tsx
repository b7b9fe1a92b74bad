/** Which machine: a published one, or a file from this computer. */

import { failureOf } from "../api/client";
import { takePublished } from "../state/machines";
import { failure, machine, published, view } from "../state/store";
import { offer } from "./machine_file";

const OWN = "\u0000own";

export function MachinePicker() {
  const { own, machine: name } = view.value;
  const choose = (value: string) => {
    if (value !== OWN) void take(value);
  };
  const known = machine.value?.definition;
  return (
    <div class="machine">
      <span>
        <label class="quiet" for="machine">
          Machine
        </label>
        <select id="machine" value={own ? OWN : name} onChange={(event) => choose(event.currentTarget.value)}>
          {published.value.map((entry) => (
            <option key={entry.name} value={entry.name}>
              {entry.name}
            </option>
          ))}
          {own && <option value={OWN}>{own.name} (own file)</option>}
        </select>
      </span>
      <label class="button">
        Open file …
        <input
          type="file"
          aria-label="Open a machine file"
          accept=".json,application/json"
          onChange={(event) => {
            const file = event.currentTarget.files?.[0];
            if (file) void offer(file);
            event.currentTarget.value = "";
          }}
        />
      </label>
      <span class="provenance" title={known?.description ?? ""}>
        {own
          ? "own file; or drop another one on the page"
          : known && name === "verne"
            ? "built-in machine: invented round dimensions, not Fatronik’s"
            : known?.description}
      </span>
    </div>
  );
}

async function take(name: string): Promise<void> {
  try {
    await takePublished(name);
    failure.value = null;
  } catch (thrown) {
    failure.value = failureOf(thrown, () => void take(name));
  }
}
