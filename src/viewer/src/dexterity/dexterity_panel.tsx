/** Which dexterity map, which of its layers, and the colours of the layers. */

import { Choice, NumberField } from "../panels/fields";
import { JobProgress } from "../panels/job_progress";
import { wanted } from "../state/store";
import { CELLS } from "../state/view";
import { cubicMetres, degrees, mm, number } from "../words/numbers";
import "./dexterity.css";
import {
  allLayers,
  compute,
  height,
  map,
  outdated,
  possible,
  run,
  set,
  settings,
  shown,
  visible,
  type DexterityMap,
} from "./dexterity_state";
import { CLASSES, countsOf } from "./reached_share";

export { keepLayersIn } from "./layer_mesh";

export function DexterityPanel() {
  const found = map.value;
  const now = run.computing.value;
  return (
    <div class="dexterity">
      <p class="hint">
        The share of a range of inclinations φ₁ that reaches each point of the part, with the tool and φ₂ of
        the page.
      </p>
      <SettingFields />
      {now ? (
        <JobProgress now={now} name="the dexterity map" cancel={() => void run.cancel()} />
      ) : (
        <div class="row between">
          <button type="button" disabled={!possible.value} onClick={() => void compute()}>
            Compute the map
          </button>
          {run.note.value && (
            <p role="status" class="trouble">
              {run.note.value}
            </p>
          )}
        </div>
      )}
      {found && <Result found={found} />}
    </div>
  );
}

function SettingFields() {
  const { from, to, cell } = settings.value;
  const angle = { unit: "°", min: -36000, max: 36000, step: 5 };
  return (
    <div class="row three">
      <NumberField
        label="First inclination"
        symbol="φ₁ from"
        value={from}
        {...angle}
        commit={(from) => set({ from })}
      />
      <NumberField
        label="Last inclination"
        symbol="φ₁ to"
        value={to}
        {...angle}
        commit={(to) => set({ to })}
      />
      <NumberField
        label="Distance between points"
        symbol="Points every"
        unit="mm"
        min={CELLS.least}
        max={CELLS.greatest}
        step={5}
        value={cell}
        commit={(cell) => set({ cell })}
      />
    </div>
  );
}

function Result({ found: { summary, layers } }: { found: DexterityMap }) {
  return (
    <div class={outdated.value ? "stale" : ""}>
      <p class="hint" data-testid="map-caption">
        {outdated.value && <strong>Other settings than those of the page: </strong>}
        {subject(summary)}
      </p>
      <dl class="figures">
        <dt>Reached by some inclination</dt>
        <dd>{volume(summary.reachable)}</dd>
        <dt>Reached by all</dt>
        <dd>{volume(summary.dexterous)}</dd>
      </dl>
      {layers.length > 0 ? (
        <Layers found={{ summary, layers }} />
      ) : (
        <p class="hint">No point of the grid is reached. A smaller distance between points may find some.</p>
      )}
    </div>
  );
}

function subject({ request: { phi1, phi2, tool_length: length } }: DexterityMap["summary"]): string {
  return `φ₁ from ${degrees(phi1.from)} to ${degrees(phi1.to)}, φ₂ ${degrees(phi2)}, tool ${mm(length)}`;
}

/** Over the scene: of which tool and inclinations the map is that the scene shows. */
export function MapCaption() {
  const found = map.value;
  const [lowest] = visible.value;
  if (!found || !lowest) return null;
  return (
    <p class={outdated.value ? "caption stale" : "caption"} data-testid="map-scene-caption">
      {outdated.value && <strong>Outdated: </strong>}
      {`Dexterity map${allLayers.value ? "" : ` at ${mm(lowest.z)} over the table`}, ${subject(found.summary)}`}
    </p>
  );
}

function volume({ volume, volume_error: error }: DexterityMap["summary"]["reachable"]): string {
  if (volume == null) return "none";
  // The printed volume has been rounded to a cm³, which the bound includes.
  const bound = Math.ceil(((error ?? 0) + 500) / 1000);
  return `${cubicMetres(volume)} ± ${number(bound, 0)} cm³`;
}

function Layers({ found: { layers } }: { found: DexterityMap }) {
  const z = layers[height.value]?.z ?? 0;
  return (
    <>
      <label class="check">
        <input
          type="checkbox"
          checked={shown.value}
          onChange={(event) => (shown.value = event.currentTarget.checked)}
        />
        show the map
      </label>
      {!wanted.value.shown && (
        <p class="hint">The surface of the workspace is hidden. “show” beside Workspace brings it back.</p>
      )}
      <Choice
        legend="Layers"
        name="layers"
        value={allLayers.value ? "all" : "one"}
        options={[
          ["one", "one"],
          ["all", "all"],
        ]}
        choose={(which) => (allLayers.value = which === "all")}
      />
      {!allLayers.value && (
        <label class="layer">
          <span>
            Height over the table <output data-testid="layer-height">{mm(z)}</output>
          </span>
          <input
            type="range"
            min={0}
            max={layers.length - 1}
            step={1}
            value={height.value}
            aria-label="Height of the layer over the table"
            aria-valuetext={mm(z)}
            onInput={(event) => (height.value = event.currentTarget.valueAsNumber)}
          />
        </label>
      )}
      <Legend />
    </>
  );
}

function Legend() {
  const counts = countsOf(visible.value);
  return (
    <table>
      <caption>Colours, by the share of the range that reaches the point</caption>
      <thead>
        <tr>
          <th scope="col">reached by</th>
          <th scope="col">points</th>
        </tr>
      </thead>
      <tbody>
        {CLASSES.map(({ name, colour }, group) => (
          <tr key={name}>
            <th scope="row">
              <svg class="swatch" viewBox="0 0 14 14" aria-hidden="true">
                <rect width="14" height="14" rx="3" fill={colour} />
              </svg>
              {name}
            </th>
            <td>{number(counts[group] ?? 0, 0)}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}
