/** What concerns the whole page, above the scene: failures with a remedy, and what a link asked for in vain. */

import { failure, notice } from "../state/store";

export function Notices() {
  const failed = failure.value;
  const noted = notice.value;
  return (
    <>
      {failed && (
        <div class="notice bad" role="alert">
          <p>{failed.sentence}</p>
          {failed.remedy && (
            <button type="button" class="small" onClick={failed.remedy.apply}>
              {failed.remedy.name}
            </button>
          )}
          <Dismiss dismiss={() => (failure.value = null)} />
        </div>
      )}
      <div role="status">
        {noted && (
          <div class="notice" data-testid="notice">
            <p>{noted}</p>
            <Dismiss dismiss={() => (notice.value = null)} />
          </div>
        )}
      </div>
    </>
  );
}

function Dismiss({ dismiss }: { dismiss: () => void }) {
  return (
    <button type="button" class="small" aria-label="Dismiss" title="Dismiss" onClick={dismiss}>
      ×
    </button>
  );
}
