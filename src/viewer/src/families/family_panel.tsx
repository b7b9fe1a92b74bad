/** Which family, its plot, and its members as a table. */

import { Choice, NumberField } from "../panels/fields";
import { JobProgress } from "../panels/job_progress";
import { wanted } from "../state/store";
import { FAMILY_COUNTS, type FamilyParameter, type ValueRange } from "../state/view";
import { degrees, mm } from "../words/numbers";
import "./family.css";
import { NAMES, valueInWords, volumeInWords } from "./family_members";
import { FamilyPlot } from "./family_plot";
import { parametersOf } from "./family_request";
import {
  choose,
  compute,
  current,
  family,
  fault,
  outdated,
  parameter,
  pointedMember,
  possible,
  ranges,
  run,
  setRange,
  showMember,
  type Family,
} from "./family_state";

const CHOICES = [
  ["tool_length", "tool length"],
  ["phi1", "φ₁"],
] as const satisfies readonly (readonly [FamilyParameter, string])[];

export function FamilyPanel() {
  const { kind } = wanted.value;
  const over = parameter.value;
  const options = parametersOf(kind);
  const found = family.value;
  return (
    <div class="family">
      {over ? (
        <>
          {options.length > 1 ? (
            <Choice legend="Volume over" name="family" value={over} options={CHOICES} choose={choose} />
          ) : (
            <p class="hint">
              Volume over the tool length: the workspace of the tool tip depends on no angle.
            </p>
          )}
          <RangeFields over={over} range={ranges.value[over]} />
          <ComputeRow />
        </>
      ) : (
        <p class="hint">
          The workspace of the platform depends neither on the tool length nor on φ₁. Choose positions of the
          tool tip or on the part.
        </p>
      )}
      {found && <Result found={found} />}
    </div>
  );
}

function RangeFields({ over, range }: { over: FamilyParameter; range: ValueRange }) {
  const set = (part: Partial<ValueRange>) => setRange(over, part);
  const length = over === "tool_length";
  const ends = length
    ? { unit: "mm", min: 0, max: 1e7, step: 10 }
    : { unit: "°", min: -36000, max: 36000, step: 5 };
  const name = length ? "tool length" : "phi 1";
  return (
    <div class="row three">
      <NumberField
        label={`First ${name}`}
        symbol="From"
        value={range.from}
        {...ends}
        commit={(from) => set({ from })}
      />
      <NumberField
        label={`Last ${name}`}
        symbol="To"
        value={range.to}
        {...ends}
        commit={(to) => set({ to })}
      />
      <NumberField
        label="Workspaces"
        hint="The number of workspaces, both ends included"
        unit=""
        decimals={0}
        min={FAMILY_COUNTS.least}
        max={FAMILY_COUNTS.greatest}
        value={range.count}
        commit={(count) => set({ count: Math.round(count) })}
      />
    </div>
  );
}

function ComputeRow() {
  const now = run.computing.value;
  const note = run.note.value ?? fault.value;
  if (now) return <JobProgress now={now} name="the family" cancel={() => void run.cancel()} />;
  return (
    <div class="row between">
      <button type="button" disabled={!possible.value} onClick={() => void compute()}>
        Compute the family
      </button>
      {note && (
        <p role="status" class="trouble">
          {note}
        </p>
      )}
    </div>
  );
}

function Result({ found }: { found: Family }) {
  const { parameter: over, members } = found;
  const member = pointedMember.value === null ? undefined : members[pointedMember.value];
  return (
    <figure class={outdated.value ? "stale" : ""}>
      <figcaption data-testid="family-caption">
        {outdated.value && <strong>Other settings than those of the page: </strong>}
        {subject(found)}
      </figcaption>
      <FamilyPlot />
      <p class="hint reading">
        {member
          ? `${valueInWords(over, member.value)}: ${volumeInWords(member)}`
          : "Click a point to show its workspace. The dashed line is the value of the page."}
      </p>
      <Table found={found} />
    </figure>
  );
}

function Table({ found: { parameter: over, members } }: { found: Family }) {
  return (
    <div class="members">
      <table>
        <thead>
          <tr>
            <th scope="col">{NAMES[over]}</th>
            <th scope="col">volume</th>
          </tr>
        </thead>
        <tbody>
          {members.map((member, place) => (
            <tr key={member.value}>
              <td>
                <button
                  type="button"
                  class="small"
                  aria-pressed={member.value === current.value}
                  aria-label={`Show the workspace for ${NAMES[over]} ${valueInWords(over, member.value)}`}
                  onClick={() => showMember(place)}
                >
                  {valueInWords(over, member.value)}
                </button>
              </td>
              <td>
                {member.volume === null ? (
                  member.reason
                ) : (
                  <data value={member.volume}>{volumeInWords(member)}</data>
                )}
              </td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

/** The settings that all members share. */
function subject({ parameter: over, common: { kind, toolLength, angles } }: Family): string {
  if (kind === "tool") return "Workspaces of the tool tip";
  const rest =
    over === "phi1"
      ? `tool ${mm(toolLength)}, φ₂ ${degrees(angles.phi2)}`
      : `φ₁ ${degrees(angles.phi1)}, φ₂ ${degrees(angles.phi2)}`;
  return `Workspaces on the part, ${rest}`;
}
