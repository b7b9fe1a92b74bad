/** What the author of the program should know. */

import { count } from "./failure_words";
import { seekLine } from "./player";
import type { OpenProgram, Plan } from "./program_state";

export function WarningList({ open, found }: { open: OpenProgram; found: Plan | null }) {
  const { warnings, warning_count: total } = found?.report ?? open.summary;
  const marks = found?.report.dwell_marks ?? [];
  const departures = found?.report.departures ?? [];
  if (warnings.length + marks.length + departures.length === 0) return null;
  const lines = total + marks.length + departures.length;
  return (
    <details>
      <summary>{lines === 1 ? "One warning" : `${count(lines)} lines with warnings`}</summary>
      <ul class="warnings">
        {warnings.map(({ line, word, detail, occurrences }) => (
          <li key={`${line} ${word} ${detail}`}>
            <Line line={line} /> {word && <code>{word}</code>} {detail}
            {occurrences > 1 ? ` (${count(occurrences)} lines)` : ""}
          </li>
        ))}
        {marks.map(({ line, angle }, i) => (
          <li key={`mark ${i}`}>
            <Line line={line} /> the tool stands on the part while the table turns by {angle.toFixed(1)}°
          </li>
        ))}
        {departures.map(({ line, distance }, i) => (
          <li key={`departure ${i}`}>
            <Line line={line} />{" "}
            {distance == null
              ? "the joints move straight in this rapid"
              : `the tool leaves the line of this rapid by ${distance.toFixed(1)} mm`}
          </li>
        ))}
      </ul>
    </details>
  );
}

function Line({ line }: { line: number }) {
  return (
    <button type="button" class="line-link" onClick={() => seekLine(line)}>
      line {count(line)}
    </button>
  );
}
