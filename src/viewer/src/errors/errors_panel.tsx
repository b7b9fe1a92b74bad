/** Which tolerances, which error, and the colours of the surface. */

import { NumberField } from "../panels/fields";
import { JobProgress } from "../panels/job_progress";
import { wanted } from "../state/store";
import type { ErrorTolerances } from "../state/view";
import { degrees, mm } from "../words/numbers";
import { groupsOf } from "./error_request";
import { bandsOf, ERRORS, MEANINGS, rangeInWords } from "./error_words";
import "./errors.css";
import {
  chosen,
  compute,
  map,
  outdated,
  possible,
  run,
  setTolerance,
  settings,
  shown,
  surface,
} from "./errors_state";

export { keepSurfaceIn } from "./error_surface";

const FIELDS: Readonly<Record<keyof ErrorTolerances, readonly [string, string, "mm" | "°"]>> = {
  rods: ["Rods", "Tolerance of the lengths of the rods", "mm"],
  sliders: ["Sliders", "Tolerance of the places of the sliders", "mm"],
  joints: ["Joints", "Tolerance of the places of the joints on sliders and platform", "mm"],
  axes: ["Axes", "Tolerance of the places of the table’s axes", "mm"],
  angles: ["Angles", "Tolerance of the directions and angles of the table’s axes", "°"],
};

export function ErrorsPanel() {
  const found = map.value;
  const now = run.computing.value;
  return (
    <div class="errors">
      <p class="hint">
        How far the tool may be from where it should, over the workspace, if the machine’s dimensions are not
        exact.
      </p>
      <Tolerances />
      {now ? (
        <JobProgress now={now} name="the errors" cancel={() => void run.cancel()} />
      ) : (
        <div class="row between">
          <button type="button" disabled={!possible.value} onClick={() => void compute()}>
            Compute the errors
          </button>
          {run.note.value && (
            <p role="status" class="trouble">
              {run.note.value}
            </p>
          )}
        </div>
      )}
      {found && <Result />}
    </div>
  );
}

function Tolerances() {
  const { tolerances } = settings.value;
  const field = (group: keyof ErrorTolerances) => {
    const [symbol, label, unit] = FIELDS[group];
    return (
      <NumberField
        key={group}
        label={label}
        symbol={symbol}
        hint={label}
        unit={unit}
        decimals={3}
        step={0.005}
        min={0}
        max={unit === "mm" ? 1000 : 90}
        value={tolerances[group]}
        commit={(value) => setTolerance({ [group]: value })}
      />
    );
  };
  const groups = groupsOf(wanted.value.kind);
  return (
    <>
      <div class="row three">{groups.slice(0, 3).map(field)}</div>
      {groups.length > 3 && <div class="row three">{groups.slice(3).map(field)}</div>}
    </>
  );
}

function Result() {
  const found = map.value;
  if (!found) return null;
  const range = found.errors?.[chosen.value];
  return (
    <div class={outdated.value ? "stale" : ""}>
      <p class="hint" data-testid="errors-caption">
        {outdated.value && <strong>Other settings than those of the page: </strong>}
        {subject()}
      </p>
      <label class="choose">
        Error
        <select
          aria-label="Error"
          value={chosen.value}
          onChange={({ currentTarget }) => (chosen.value = kindOf(currentTarget.value))}
        >
          {ERRORS.map(([error, name]) => (
            <option key={error} value={error}>
              {name}
            </option>
          ))}
        </select>
      </label>
      <dl class="figures">
        <dt>From, to the largest found</dt>
        <dd data-testid="errors-range">{rangeInWords(chosen.value, found)}</dd>
        {range && (
          <>
            <dt>The largest at</dt>
            <dd>{range.at.map((value) => mm(value)).join(", ")}</dd>
          </>
        )}
      </dl>
      <p class="hint">{MEANINGS[chosen.value]}</p>
      <label class="check">
        <input
          type="checkbox"
          checked={shown.value}
          onChange={(event) => (shown.value = event.currentTarget.checked)}
        />
        show the surface
      </label>
      <Bands />
    </div>
  );
}

function Bands() {
  const found = surface.value;
  const unbounded = map.value?.unbounded ?? 0;
  if (!found) return null;
  return (
    <>
      <ul aria-label="Colours of the surface, by the error there">
        {bandsOf(found).map(({ name, colour }) => (
          <li key={name}>
            <svg class="swatch" viewBox="0 0 14 14" aria-hidden="true">
              <rect width="14" height="14" rx="3" fill={colour} />
            </svg>
            {name}
          </li>
        ))}
      </ul>
      {unbounded > 0 && (
        <p class="hint">
          At {unbounded} corners of the surface errors have no bound: the platform is no longer held. They
          have the colour of the largest errors.
        </p>
      )}
      {!wanted.value.shown && (
        <p class="hint">The usual surface is hidden. “show” beside Workspace brings it back.</p>
      )}
    </>
  );
}

function subject(): string {
  const request = map.value?.request.workspace;
  if (!request) return "";
  const { kind } = request;
  if (kind === "platform") return "Errors of P over the workspace of the platform";
  const length = "tool_length" in request ? mm(request.tool_length ?? 0) : "";
  if (kind === "tool") return `Errors of the tool end, tool ${length}`;
  const angles =
    "phi1" in request ? `, φ₁ ${degrees(request.phi1 ?? 0)}, φ₂ ${degrees(request.phi2 ?? 0)}` : "";
  return `Errors of the tool end on the part, tool ${length}${angles}`;
}

function kindOf(word: string): (typeof ERRORS)[number][0] {
  return ERRORS.find(([error]) => error === word)?.[0] ?? "tip_worst";
}
