/** Which workspace, its figures, and what it takes to have it. */

import type { WorkspaceKind, WorkspaceSummary } from "verne-client";
import { again, cancelComputation, outdated } from "../state/computation";
import {
  change,
  changeWorkspace,
  computing,
  overTable,
  wanted,
  workspace,
  workspaceAngles,
  workspaceNote,
} from "../state/store";
import { cubicMetres, number, squareMetres } from "../words/numbers";
import { Downloads } from "./downloads";
import { Choice, NumberField } from "./fields";
import { JobProgress } from "./job_progress";
import { Legend } from "./legend";
import { SectionControls } from "./section";

const KINDS = [
  ["platform", "platform"],
  ["tool", "tool tip"],
  ["part", "on the part"],
] as const satisfies readonly (readonly [WorkspaceKind, string])[];

export function WorkspacePanel() {
  const asked = wanted.value;
  const found = workspace.value;
  const { phi1, phi2 } = workspaceAngles.value ?? asked;
  const pin = (angles: { phi1?: number; phi2?: number }) =>
    changeWorkspace({ phi1, phi2, ...angles, follows: false });
  return (
    <section aria-labelledby="workspace">
      <header>
        <h2 id="workspace">Workspace</h2>
        <label class="check">
          <input
            type="checkbox"
            checked={asked.shown}
            onChange={(event) => changeWorkspace({ shown: event.currentTarget.checked })}
          />
          show
        </label>
        <label class="check">
          <input
            type="checkbox"
            checked={asked.solid}
            onChange={(event) => changeWorkspace({ solid: event.currentTarget.checked })}
          />
          solid
        </label>
      </header>
      <Choice
        legend="Positions of"
        name="kind"
        value={asked.kind}
        options={KINDS}
        choose={(kind) => change({ workspace: { ...asked, kind }, section: null })}
      />
      {asked.kind === "part" ? (
        <TableFields />
      ) : (
        <p class="hint">The table is not checked here: its tilt is left open.</p>
      )}
      <div class="row three">
        {asked.kind === "part" && (
          <>
            <NumberField
              label="Tool inclination on the part, phi 1"
              symbol="φ₁"
              unit="°"
              value={phi1}
              step={5}
              commit={(phi1) => pin({ phi1 })}
            />
            <NumberField
              label="Tool azimuth on the part, phi 2"
              symbol="φ₂"
              unit="°"
              value={phi2}
              step={5}
              commit={(phi2) => pin({ phi2 })}
            />
          </>
        )}
        <NumberField
          label="Tolerance of the mesh"
          symbol="Within"
          unit="mm"
          value={asked.tolerance}
          decimals={2}
          step={0.05}
          min={0.01}
          max={1000}
          commit={(tolerance) => changeWorkspace({ tolerance })}
        />
      </div>
      {asked.kind === "part" && (
        <label class="check">
          <input
            type="checkbox"
            checked={asked.follows}
            onChange={(event) => {
              if (event.currentTarget.checked) changeWorkspace({ follows: true });
              else pin({});
            }}
          />
          φ₁ and φ₂ follow the machine
        </label>
      )}
      <Progress />
      {found && <Figures found={found} />}
      {found && found.bounds && <SectionControls found={found} bounds={found.bounds} />}
      {found && found.triangles > 0 && <Legend />}
      {found && found.triangles > 0 && <Downloads found={found} />}
    </section>
  );
}

/** The table as a limit: it holds for the margins as well. */
function TableFields() {
  const { table_clearance: least } = overTable.value;
  return (
    <div class="row three">
      <NumberField
        label="Least height of tool and platform over the table"
        symbol="Over table"
        unit="mm"
        value={least}
        step={5}
        min={0}
        max={1e6}
        commit={(clearance) => change({ clearance })}
      />
    </div>
  );
}

function Progress() {
  const now = computing.value;
  const note = workspaceNote.value;
  if (now)
    return (
      <div data-testid="progress">
        <JobProgress now={now} name="the workspace" cancel={() => void cancelComputation()} />
      </div>
    );
  if (!note) return null;
  return (
    <div class="progress">
      <p role="status" class="trouble" data-testid="workspace-note">
        {note}
        {outdated.value && " The last workspace remains, in grey."}
      </p>
      {(outdated.value || !workspace.value) && (
        <button type="button" class="small" onClick={again}>
          Compute again
        </button>
      )}
    </div>
  );
}

function Figures({ found }: { found: WorkspaceSummary }) {
  const stale = outdated.value ? " stale" : "";
  const up = found.frame === "base" ? "z down" : "z up";
  return (
    <>
      <dl class={`figures${stale}`}>
        <dt>Volume</dt>
        <dd class="main">
          {found.volume == null ? (
            "none"
          ) : (
            <data data-testid="volume" value={found.volume}>
              {cubicMetres(found.volume)}
            </data>
          )}
        </dd>
        <dt>Plan area</dt>
        <dd>{squareMetres(found.area)}</dd>
        <dt>Mesh</dt>
        <dd>{number(found.triangles, 0)} triangles</dd>
      </dl>
      <dl class={`bounds${stale}`} aria-label="Bounds">
        {["x", "y", up].map((axis, i) => (
          <div key={axis}>
            <dt>{axis}, mm</dt>
            <dd>
              {found.bounds
                ? `${number(found.bounds.min[i] ?? 0, 0)} … ${number(found.bounds.max[i] ?? 0, 0)}`
                : "none"}
            </dd>
          </div>
        ))}
      </dl>
    </>
  );
}
