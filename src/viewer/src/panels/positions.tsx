/** Every position with the same sliders, or with the same tool pose: the same platform position, shown as ghosts, and picked. */

import type { Position } from "../state/store";
import { change, ghosts, ghostKind, pointed, position } from "../state/store";
import { samePosition } from "../state/same";
import { pick } from "../state/motion";
import { broken } from "../words/limits";
import { degrees, mm } from "../words/numbers";
import { MODES } from "../words/symbols";
import { Fragment } from "preact";
import { Choice } from "./fields";

const SHOWN = [
  ["none", "none"],
  ["assembly", "sliders"],
  ["platform", "platform"],
  ["inverse", "tool pose"],
] as const;

export function PositionsPanel() {
  const kind = ghostKind.value;
  const found = ghosts.value;
  const here = position.value;
  return (
    <section aria-labelledby="positions">
      <header>
        <h2 id="positions">Other solutions</h2>
        {kind !== "none" && <output data-testid="ghost-count">{found.length}</output>}
      </header>
      <Choice
        legend="Ghosts with the same"
        name="ghosts"
        value={kind}
        options={SHOWN}
        choose={(ghosts) => change({ ghosts })}
      />
      {found.length > 0 && (
        <ul class="ghosts" aria-label={kind === "assembly" ? "Assembly modes" : "Inverse solutions"}>
          {found.map((ghost, i) => (
            <li key={i}>
              <button
                type="button"
                aria-pressed={here !== null && samePosition(ghost, here)}
                class={pointed.value === i ? "pointed" : ""}
                onClick={() => pick(ghost)}
                onPointerEnter={() => (pointed.value = i)}
                onPointerLeave={() => (pointed.value = null)}
                onFocus={() => (pointed.value = i)}
                onBlur={() => (pointed.value = null)}
              >
                <span class={ghost.solution.feasible ? "index" : "index broken"}>{i + 1}</span>
                <span>{kind === "assembly" ? byPose(ghost) : bySliders(ghost)}</span>
                <Tags ghost={ghost} />
                {!ghost.solution.feasible && (
                  <span class="reason">{broken(ghost.solution.margins.worst)}</span>
                )}
              </button>
            </li>
          ))}
        </ul>
      )}
      {found.length > 0 && (
        <details>
          <summary>Colours and words</summary>
          <dl class="words">
            <dt>
              <span class="index">1</span> <span class="index broken">2</span>
            </dt>
            <dd>keeps every limit; breaks a limit, which is named</dd>
            {MODES.map(({ symbol, meaning }) => (
              <Fragment key={symbol}>
                <dt>{symbol}</dt>
                <dd>{meaning}</dd>
              </Fragment>
            ))}
          </dl>
        </details>
      )}
    </section>
  );
}

function Tags({ ghost: { solution } }: { ghost: Position }) {
  const { working, feasible, mode } = solution;
  const meaning = (word: string) => MODES.find(({ symbol }) => symbol === word)?.meaning;
  if (working)
    return (
      <span class={feasible ? "tag good" : "tag warn"} title={meaning("working")}>
        working
      </span>
    );
  const below = [mode.leg1, mode.leg2, mode.leg3].flatMap((side, i) => (side === "below" ? [i + 1] : []));
  const words = [below.length > 0 ? `leg ${below.join(", ")} below` : "", mode.crossed ? "crossed" : ""];
  const said = words.filter(Boolean).join("; ") || "other branch";
  return (
    <span
      class="tag"
      title={meaning(mode.crossed ? "crossed" : below.length > 0 ? "leg 2 below" : "other branch")}
    >
      {said}
    </span>
  );
}

function byPose({ solution: { platform } }: Position): string {
  return `z ${mm(platform.z, 0)}, α ${degrees(platform.alpha)}`;
}

function bySliders({ joints: { rho } }: Position): string {
  return `ρ ${rho.map((value) => mm(value, 0).replace(/\u00a0mm$/, "")).join(", ")} mm`;
}
