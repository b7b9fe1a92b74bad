/** The plane that cuts the workspace, and what it finds. */

import { useSignal } from "@preact/signals";
import type { Schemas, WorkspaceSummary } from "verne-client";
import { clamp } from "../state/joints";
import { change, section, slice } from "../state/store";
import { squareMetres } from "../words/numbers";
import { SlideField } from "./slide";

interface Props {
  found: WorkspaceSummary;
  bounds: Schemas["Bounds"];
}

export function SectionControls({ found, bounds }: Props) {
  const last = useSignal<number | null>(null);
  const [min, max] = [bounds.min[2] ?? 0, bounds.max[2] ?? 0];
  const height = section.value;
  const area = slice.value?.area;
  const toggle = (wanted: boolean) => {
    if (!wanted) last.value = height;
    const start =
      last.value !== null && last.value > min && last.value < max ? last.value : Math.round((min + max) / 2);
    change({ section: wanted ? start : null });
  };
  return (
    <div class="section">
      <div class="row between">
        <label class="check">
          <input
            type="checkbox"
            checked={height !== null}
            onChange={(event) => toggle(event.currentTarget.checked)}
          />
          Section plane
        </label>
        {height !== null && area !== undefined && (
          <output data-testid="slice-area">{squareMetres(area)}</output>
        )}
      </div>
      {height !== null && (
        <SlideField
          label={
            found.frame === "base" ? "Height of the section, z down" : "Height of the section above the table"
          }
          symbol="z"
          unit="mm"
          value={height}
          min={Math.ceil(min)}
          max={Math.floor(max)}
          step={1}
          commit={(section) => change({ section })}
          nudge={(by) => change({ section: clamp((section.peek() ?? height) + by, min, max) })}
        />
      )}
    </div>
  );
}
