/** What a question beside the plan is doing, or why it has no answer. */

import { number } from "../words/numbers";
import type { Inquiry } from "./inquiry";

interface Props {
  inquiry: Inquiry<unknown>;
  /** Names the progress for those who listen. */
  name: string;
}

export function InquiryProgress({ inquiry, name }: Props) {
  const now = inquiry.activity.value;
  if (!now) {
    const trouble = inquiry.trouble.value;
    return trouble === null ? null : (
      <p class="trouble" role="status">
        {trouble}
      </p>
    );
  }
  return (
    <div class="progress">
      <label>
        <span>
          {now.words}
          {now.fraction === null ? "" : ` ${number(now.fraction * 100, 0)} %`}
        </span>
        <progress
          max={1}
          {...(now.fraction === null ? {} : { value: now.fraction })}
          aria-label={`Progress of ${name}`}
        />
      </label>
      <button type="button" class="small" onClick={() => inquiry.cancel()}>
        Cancel
      </button>
    </div>
  );
}
