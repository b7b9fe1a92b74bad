/** How far a computation is, and a button that cancels it. */

import type { Computing } from "../state/store";
import { number } from "../words/numbers";

interface Props {
  now: Computing;
  /** The name of what is computed, as in "the family". */
  name: string;
  cancel: () => void;
}

export function JobProgress({ now, name, cancel }: Props) {
  return (
    <div class="progress">
      <label>
        <span>
          {now.state === "queued" ? "Waiting for its turn …" : "Computing …"}
          {now.progress !== null && now.job ? ` ${number(now.progress * 100, 0)} %` : ""}
        </span>
        <progress
          max={1}
          {...(now.progress === null ? {} : { value: now.progress })}
          aria-label={`Progress of ${name}`}
        />
      </label>
      <button type="button" class="small" onClick={cancel}>
        Cancel
      </button>
    </div>
  );
}
