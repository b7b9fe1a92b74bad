/** Where the machine cannot run the program, in words. */

import { useState } from "preact/hooks";
import type { ToolpathReport } from "verne-client";
import { changeWords, count, failureSentence } from "./failure_words";
import { goToFailure, heal, rewind } from "./failures";
import { activity, settings } from "./program_state";

const FEW = 5;

export function FailureList({ report }: { report: ToolpathReport }) {
  const [all, setAll] = useState(false);
  const { failures, failure_count: total } = report;
  if (failures.length === 0) return null;
  const busy = activity.value !== null;
  return (
    <>
      <h3 id="failures">
        {total === 1 ? "One stretch fails" : `${count(total)} stretches fail`}
        {failures.length < total ? `; the first ${count(failures.length)} of them` : ""}
      </h3>
      <ol class="failures" aria-labelledby="failures">
        {(all ? failures : failures.slice(0, FEW)).map((failure, i) => (
          <li key={i}>
            <button type="button" class="failure-line" onClick={() => goToFailure(failure)}>
              {failureSentence(failure)}
            </button>
            {failure.text && <code title={failure.text}>{failure.text}</code>}
            {failure.constraint === "rotary" && settings.value.onLimit === "fail" && (
              <button type="button" class="small" disabled={busy} onClick={rewind}>
                retract there and turn the table back
              </button>
            )}
            {failure.change && (
              <button type="button" class="small" disabled={busy} onClick={() => heal(failure)}>
                {changeWords(failure.change)}
              </button>
            )}
          </li>
        ))}
      </ol>
      {failures.length > FEW && (
        <button type="button" class="small" aria-expanded={all} onClick={() => setAll(!all)}>
          {all ? `Show the first ${FEW}` : `Show all ${count(failures.length)}`}
        </button>
      )}
    </>
  );
}
