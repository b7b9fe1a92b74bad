/** Which plane, its map, where the machine stands in it, and the legend. */

import { Choice, NumberField } from "../panels/fields";
import { refusal } from "../state/store";
import "./atlas.css";
import { AtlasLegend } from "./atlas_legend";
import { AtlasMap } from "./atlas_map";
import type { Point } from "./atlas_plane";
import { atlas, choose, go, here, solutionsHere, space, trouble } from "./atlas_state";
import { PLANES, solutionsInWords } from "./atlas_words";

export function AtlasPanel() {
  const found = atlas.value;
  const plane = PLANES[space.value];
  return (
    <div class="atlas">
      <p class="hint">{plane.counted}, whether limits are kept or not.</p>
      <Choice
        legend="Plane of"
        name="atlas"
        value={space.value}
        options={[
          ["platform", "platform"],
          ["joints", "sliders"],
        ]}
        choose={choose}
      />
      {found ? (
        <>
          <AtlasMap atlas={found} />
          <Standing />
          <AtlasLegend atlas={found} />
        </>
      ) : trouble.value ? (
        <p class="trouble" role="status">
          {trouble.value}
        </p>
      ) : (
        <p class="hint">Computing …</p>
      )}
    </div>
  );
}

/** Where the machine stands, to read and to type. */
function Standing() {
  const at = here.value;
  const plane = PLANES[space.value];
  const solutions = solutionsHere.value;
  if (!at) return null;
  const field = (name: string, axis: 0 | 1) => (
    <NumberField
      label={`${space.value === "platform" ? "Platform" : "Sliders"} ${name} on the map`}
      symbol={name}
      unit="mm"
      value={at[axis]}
      commit={(value) => go(at.with(axis, value) as unknown as Point)}
    />
  );
  return (
    <>
      <p role="status" data-testid="atlas-here">
        {solutions === null
          ? "The machine stands outside of the map."
          : `The machine stands where there ${solutions === 1 ? "is" : "are"} ${solutionsInWords(solutions)}.`}
      </p>
      <div class="row two">
        {field(plane.u, 0)}
        {field(plane.v, 1)}
      </div>
      {refusal.value && <p class="trouble">{refusal.value.sentence}</p>}
      <p class="hint">
        Click the map to lead the machine there. “Other solutions” shows the solutions of a place:{" "}
        {space.value === "platform" ? "those with the same platform" : "those with the same sliders"}.
      </p>
    </>
  );
}
