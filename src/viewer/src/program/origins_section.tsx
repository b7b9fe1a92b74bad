/** A button that shows in the scene where the origin of the set-up may be. */

import { NumberField } from "../panels/fields";
import { InquiryProgress } from "./inquiry_progress";
import { askRegion, cell, origins, regionOutdated } from "./origins";
import { regionHint, regionWords } from "./origins_words";

export function OriginsSection() {
  const found = origins.found.value;
  const busy = origins.activity.value !== null;
  const shown = found !== null || busy;
  return (
    <div class="origins">
      <div class="row">
        <button
          type="button"
          class="small"
          aria-pressed={shown}
          onClick={() => (shown ? origins.forget() : askRegion())}
        >
          Region of origins
        </button>
        <NumberField
          label="Cell of the region of origins"
          symbol="Cell"
          unit="mm"
          value={cell.value}
          decimals={0}
          min={10}
          max={200}
          step={10}
          commit={(value) => {
            cell.value = value;
            if (shown) askRegion();
          }}
        />
      </div>
      <InquiryProgress inquiry={origins} name="the region of origins" />
      {found && regionOutdated.value && !busy && (
        <p class="verdict">
          <span class="tag warn">outdated</span> The region is that of other settings.{" "}
          <button type="button" class="small" onClick={askRegion}>
            Compute again
          </button>
        </p>
      )}
      {found && !regionOutdated.value && (
        <>
          <p data-testid="region">{regionWords(found.answer)}</p>
          <p class="hint">{regionHint(found.answer.request.cell)}</p>
        </>
      )}
    </div>
  );
}
