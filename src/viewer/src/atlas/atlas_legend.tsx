/** What the map's colours, lines and marks mean. */

import type { Atlas } from "verne-client";
import { number } from "../words/numbers";
import { sharesOf } from "./atlas_plane";
import { areaInWords, colourOf, CURVES, pointsInWords, solutionsInWords, WORKING } from "./atlas_words";

export function AtlasLegend({ atlas }: { atlas: Atlas }) {
  const shares = sharesOf(atlas);
  const counts = shares.map(({ solutions }) => solutions);
  const whole = shares.reduce((sum, { area }) => sum + area, 0) || 1;
  const kinds = [...new Set(atlas.curves.map(({ kind }) => kind))];
  return (
    <>
      <table>
        <caption>Numbers of solutions, with the areas of their regions</caption>
        <tbody>
          {shares.map(({ solutions, area, error }) => (
            <tr key={solutions}>
              <th scope="row">
                <svg class="swatch" viewBox="0 0 14 14" aria-hidden="true">
                  <rect width="14" height="14" rx="3" fill={colourOf(solutions, counts)} />
                </svg>
                {solutionsInWords(solutions)}
              </th>
              <td>{areaInWords({ area, error })}</td>
              <td>{number((area / whole) * 100, 1)} %</td>
            </tr>
          ))}
        </tbody>
      </table>
      <ul>
        {kinds.map((kind) => (
          <li key={kind}>
            <svg class="stroke" viewBox="0 0 24 8" aria-hidden="true">
              <path class={`curve ${kind}`} d="M0 4H24" />
            </svg>
            {CURVES[kind]}
          </li>
        ))}
        <li>
          <svg class="stroke" viewBox="0 0 24 8" aria-hidden="true">
            <path class="working-line" d="M2 8 10 0M9 8 17 0M16 8 24 0" />
          </svg>
          {WORKING}: {areaInWords({ area: atlas.working.area, error: workingError(atlas) })}
        </li>
      </ul>
      {atlas.points.length > 0 && <p class="hint">Marked points: {pointsInWords(atlas.points)}.</p>}
      <p class="hint">
        The service compared these numbers with its solutions at {number(atlas.checked_points, 0)} points.
      </p>
    </>
  );
}

function workingError({ working }: Atlas): number {
  return working.regions.reduce((sum, { area_error: error }) => sum + error, 0);
}
