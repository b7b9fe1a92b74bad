/** What limits each piece of the boundary, in the mesh's own colours. A row that is pointed at isolates its pieces. */

import { keptLimit, pointedLimit, section, surfaces, type Surface } from "../state/store";
import { limitInWords } from "../words/elements";
import { number } from "../words/numbers";

export function Legend() {
  const pieces = surfaces.value.filter(({ share }) => share > 0);
  if (pieces.length === 0) return null;
  return (
    <div class="legend">
      <h3 id="legend">What limits it, by share of the surface</h3>
      <ul aria-labelledby="legend">
        {pieces.map((piece) => (
          <Row key={piece.name} piece={piece} />
        ))}
      </ul>
      {section.value !== null && (
        <p class="cut-face">
          <Hatch />
          cut face, no limit
        </p>
      )}
      <p class="hint">Point at a row or at a face to see it alone; click to keep it so.</p>
    </div>
  );
}

function Row({ piece: { name, rgb, share } }: { piece: Surface }) {
  const kept = keptLimit.value === name;
  return (
    <li>
      <button
        type="button"
        aria-pressed={kept}
        class={pointedLimit.value === name ? "pointed" : ""}
        onClick={() => (keptLimit.value = kept ? null : name)}
        onPointerEnter={() => (pointedLimit.value = name)}
        onPointerLeave={() => (pointedLimit.value = null)}
        onFocus={() => (pointedLimit.value = name)}
        onBlur={() => (pointedLimit.value = null)}
      >
        <svg class="swatch" viewBox="0 0 14 14" aria-hidden="true">
          <rect width="14" height="14" rx="3" fill={`rgb(${rgb.join(" ")})`} />
        </svg>
        <span>{limitInWords(name)}</span>
        <span class="share">{share < 0.001 ? "< 0.1" : number(share * 100, 1)} %</span>
      </button>
    </li>
  );
}

function Hatch() {
  return (
    <svg class="swatch hatch" viewBox="0 0 14 14" aria-hidden="true">
      <rect width="14" height="14" rx="3" />
      <path d="M0 7 7 0M0 14 14 0M7 14 14 7" />
    </svg>
  );
}
