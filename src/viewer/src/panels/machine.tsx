/** Which machine: a published one, or a file from this computer. */

import { machine, published, view } from "../state/store";
import { takePublished } from "../state/machines";
import { failure } from "../state/store";
import { inWords } from "../api/client";
import { offer } from "./machine_file";

const OWN = "\u0000own";

export function MachinePicker() {
  const { own, machine: name } = view.value;
  const choose = (value: string) => {
    if (value !== OWN) takePublished(value).catch((thrown: unknown) => (failure.value = inWords(thrown)));
  };
  const known = machine.value?.definition;
  return (
    <div class="machine">
      <label>
        <span class="quiet">Machine</span>
        <select value={own ? OWN : name} onChange={(event) => choose(event.currentTarget.value)}>
          {published.value.map((entry) => (
            <option key={entry.name} value={entry.name}>{entry.name}</option>
          ))}
          {own && <option value={OWN}>{own.name} (own file)</option>}
        </select>
      </label>
      <label class="button">
        Open a machine file
        <input type="file" accept=".json,application/json" onChange={(event) => {
          const file = event.currentTarget.files?.[0];
          if (file) void offer(file);
          event.currentTarget.value = "";
        }} />
      </label>
      <span class="provenance" title={known?.description ?? ""}>
        {own ? "own file; or drop another one on the page" : known && name === "verne" ? "built-in machine: invented round dimensions, not Fatronik’s" : known?.description}
      </span>
    </div>
  );
}
