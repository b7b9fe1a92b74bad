/** The colours of the path and of the time bar. */

import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { GREATEST, isDark, marginColour, onTheme } from "./colours";

const STEPS = 12;
const dark = signal(isDark());

export function MarginLegend() {
  useEffect(() => onTheme(() => (dark.value = isDark())), []);
  const fill = (fraction: number) => `rgb(${marginColour(fraction, dark.value).join(" ")})`;
  return (
    <span class="margin-legend">
      <svg viewBox="0 0 8 8" width="10" aria-hidden="true">
        <rect width="8" height="8" fill={fill(-1)} />
      </svg>{" "}
      broken, 0 %{" "}
      <svg viewBox={`0 0 ${STEPS * 6} 8`} width={STEPS * 6} aria-hidden="true">
        {Array.from({ length: STEPS }, (_, i) => (
          <rect key={i} x={6 * i} width="6" height="8" fill={fill((i / (STEPS - 1)) * GREATEST)} />
        ))}
      </svg>{" "}
      {GREATEST * 100} % and more; rapids dashed
    </span>
  );
}
