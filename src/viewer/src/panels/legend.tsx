/** What limits each piece of the boundary, in the mesh's own colours. */

import type { Schemas } from "verne-client";
import { surfaces, type Surface } from "../state/store";
import { boundary } from "../words/elements";
import { number } from "../words/numbers";

export function Legend() {
  const pieces = surfaces.value.filter(({ share }) => share > 0);
  if (pieces.length === 0) return null;
  return (
    <div class="legend">
      <h3 id="legend">What limits it, by share of the surface</h3>
      <ul aria-labelledby="legend">
        {pieces.map((piece) => (
          <li key={piece.name}>
            <Swatch rgb={piece.rgb} />
            <span>{words(piece)}</span>
            <span class="share">{piece.share < 0.001 ? "< 0.1" : number(piece.share * 100, 1)} %</span>
          </li>
        ))}
      </ul>
    </div>
  );
}

function Swatch({ rgb }: { rgb: Surface["rgb"] }) {
  return (
    <svg class="swatch" viewBox="0 0 14 14" aria-hidden="true">
      <rect width="14" height="14" rx="3" fill={`rgb(${rgb.join(" ")})`} />
    </svg>
  );
}

function words({ name }: Surface): string {
  const [constraint = "", element = ""] = name.split(" ");
  return boundary(constraint as Schemas["Constraint"], element);
}
