/** How far every limit is, worst first. */

import { useState } from "preact/hooks";
import { machine, position, type Position } from "../state/store";
import { bars, type Bar } from "../words/margins";

const FEW = 4;

export function MarginsPanel() {
  const [all, setAll] = useState(false);
  const known = machine.value;
  const solution = position.value?.solution;
  if (!known || !solution) return null;
  const found = bars(solution.margins, known.definition, known.home);
  const broken = found.filter((bar) => bar.part < 0).length;
  return (
    <section aria-labelledby="margins">
      <header>
        <h2 id="margins">Margins of this pose</h2>
        <span class={broken > 0 ? "tag bad" : "tag good"}>
          {broken > 0 ? `${broken} broken` : "all kept"}
        </span>
      </header>
      <p class="hint" data-testid="not-checked">
        Not checked: {listOf(position.value?.notChecked ?? [])}.
      </p>
      <ol class="bars" data-testid="margins">
        {(all ? found : found.slice(0, FEW)).map((bar) => (
          <li key={`${bar.constraint} ${bar.element}`}>
            <span class="sentence">{bar.sentence}</span>
            <meter class={tone(bar)} min={0} max={1} value={length(bar)} aria-label={bar.sentence} />
          </li>
        ))}
      </ol>
      <button type="button" class="small" aria-expanded={all} onClick={() => setAll(!all)}>
        {all ? "Show the worst only" : `Show all ${found.length}`}
      </button>
    </section>
  );
}

/** What the margins do not tell. */
function listOf(notChecked: Position["notChecked"]): string {
  return notChecked
    .map((what) => ({ table: "the table", part: "the part", fixtures: "fixtures" })[what])
    .join(", ");
}

function tone({ part }: Bar): string {
  if (part < 0) return "bad";
  return part < 0.05 ? "warn" : "good";
}

/** A broken limit fills its bar. */
function length({ part }: Bar): number {
  return part < 0 ? 1 : Math.min(part, 1);
}
