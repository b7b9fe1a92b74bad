/** The program: what it is, whether the machine can run it, and what would change that. */

import { change } from "../state/store";
import { mm, number } from "../words/numbers";
import { count, clock } from "./failure_words";
import { FailureList } from "./failure_list";
import { FORMAT_NAMES, type Format } from "./formats";
import { cancelSending, unsent } from "./open_program";
import { cancelPlanning, outdated, planAgain } from "./planning";
import { PlacementSection } from "./placement_section";
import { ProgramDownloads } from "./program_downloads";
import {
  activity,
  faults,
  plan,
  program,
  shownLine,
  trouble,
  type OpenProgram,
  type Plan,
} from "./program_state";
import { SetUpFields } from "./set_up_fields";
import { ASSUMED_SPEED } from "./timeline";
import { WarningList } from "./warning_list";

export function ProgramPanel() {
  const open = program.value;
  const found = plan.value;
  return (
    <div class="program">
      {open && <Name open={open} />}
      <Activity />
      {open && found && (outdated.value ? <Outdated /> : <Verdict found={found} />)}
      {found && <FailureList report={found.report} />}
      {open && found && <PlacementSection key={open.summary.id} />}
      {open && <Figures open={open} found={found} />}
      {open && <SetUpFields open={open} />}
      {open && <WarningList open={open} found={found} />}
      {open && found && !outdated.value && <ProgramDownloads open={open} report={found.report} />}
    </div>
  );
}

function Name({ open: { summary, name } }: { open: OpenProgram }) {
  return (
    <div class="row between">
      <span class="file-name" title={name}>
        <b>{name}</b> <span class="quiet">{FORMAT_NAMES[summary.format as Format]}</span>
      </span>
      <button type="button" class="small" onClick={() => change({ program: null })}>
        Close
      </button>
    </div>
  );
}

/** What is under way, or why nothing came of it. */
function Activity() {
  const now = activity.value;
  if (now) {
    const cancel = () => {
      cancelSending();
      void cancelPlanning();
    };
    return (
      <div class="progress" data-testid="program-progress">
        <label>
          <span>
            {now.words}
            {now.fraction === null ? "" : ` ${number(now.fraction * 100, 0)} %`}
          </span>
          <progress
            max={1}
            {...(now.fraction === null ? {} : { value: now.fraction })}
            aria-label="Progress of the program"
          />
        </label>
        <button type="button" class="small" onClick={cancel}>
          Cancel
        </button>
      </div>
    );
  }
  if (!trouble.value) return null;
  return (
    <>
      <div class="progress">
        <p class="trouble" role="status" data-testid="program-trouble">
          {faults.value.length > 0 ? "These lines do not fit the set-up:" : trouble.value}
        </p>
        {(unsent.value ?? program.value) && (
          <button type="button" class="small" onClick={unsent.value ?? planAgain}>
            {unsent.value ? "Send again" : "Plan again"}
          </button>
        )}
      </div>
      <ol class="failures" aria-label="Lines that do not fit the set-up">
        {faults.value.map(({ line, word, detail }) => (
          <li key={`${line} ${word}`}>
            <button type="button" class="failure-line" onClick={() => (shownLine.value = line)}>
              line {count(line)}: {word !== "" && `${word}: `}
              {detail}
            </button>
          </li>
        ))}
      </ol>
    </>
  );
}

/** What is shown is true of other settings than those in the fields. */
function Outdated() {
  return (
    <p class="verdict" data-testid="outdated">
      <span class="tag warn">outdated</span> The motion that is shown is that of the settings before.
    </p>
  );
}

function Verdict({ found: { report, bucket } }: { found: Plan }) {
  const ok = report.verdict === "ok";
  const unchecked = report.not_checked.map((what) => `the ${what}`).join(" and ");
  return (
    <>
      <p class="verdict" data-testid="verdict">
        <span class={ok ? "tag good" : "tag bad"}>{ok ? "runs" : "fails"}</span>{" "}
        {ok ? "The machine can run the program." : "The machine cannot run the program as it is set up."}
      </p>
      {unchecked !== "" && (
        <p class="hint">Not checked: {unchecked.replaceAll("the fixtures", "fixtures")}.</p>
      )}
      {bucket > 1 && (
        <p class="hint" data-testid="thinned">
          {count(report.rows)} rows are too many for the page: of each {bucket} rows it shows those with the
          extremes of the joints and of the margin. Files have all rows.
        </p>
      )}
      {report.time.unknown_rows > 0 && (
        <p class="hint">
          {report.time.unknown_rows === 1
            ? "One row has no known duration, such as a rapid without drives. It is"
            : `${count(report.time.unknown_rows)} rows have no known duration, such as rapids without drives. They are`}{" "}
          played at {ASSUMED_SPEED.slider} mm/s and {ASSUMED_SPEED.table}°/s.
        </p>
      )}
    </>
  );
}

function Figures({ open: { summary }, found }: { open: OpenProgram; found: Plan | null }) {
  const { min, max } = summary.bounds;
  const tools = summary.tools.map(({ number: tool, length }) => {
    const name = tool == null ? "a tool" : `T${tool}`;
    return length == null ? name : `${name} (${mm(length, 0)})`;
  });
  const report = found?.report;
  return (
    <>
      <dl class="figures">
        <dt>Moves</dt>
        <dd data-testid="moves">{count(summary.moves)}</dd>
        <dt>Tools</dt>
        <dd>{tools.length > 0 ? tools.join(", ") : "none stated"}</dd>
        {report && (
          <>
            <dt>Time</dt>
            <dd>{report.time.seconds > 0 ? clock(report.time.seconds) : "not known"}</dd>
            <dt>Feed moves</dt>
            <dd>{mm(report.length.feed, 0)}</dd>
            <dt>Joint rows</dt>
            <dd>{count(report.rows)}</dd>
          </>
        )}
      </dl>
      <dl class="bounds" aria-label="Bounds of the program">
        {["x", "y", "z"].map((axis, i) => (
          <div key={axis}>
            <dt>{axis}, mm</dt>
            <dd>
              {number(min[i] ?? 0, 0)} … {number(max[i] ?? 0, 0)}
            </dd>
          </div>
        ))}
      </dl>
    </>
  );
}
