/** A button that finds a set-up, and its answer: before and after, the lines that limit it, and the guarantee. */

import { useState } from "preact/hooks";
import type { Placement } from "verne-client";
import { degrees, mm } from "../words/numbers";
import { InquiryProgress } from "./inquiry_progress";
import { freedoms, givenRequest, placing, standing, usePlacement } from "./placement";
import { usualFreedoms } from "./placement_bounds";
import { PlacementForm } from "./placement_form";
import { activeWords, guaranteeWords, reserveWords } from "./placement_words";
import { showLine } from "./player";
import { settings } from "./program_state";

/** Margins that are listed. */
const MOST = 6;

export function PlacementSection() {
  const [asking, setAsking] = useState(false);
  const found = placing.found.value;
  const toggle = () => {
    if (!asking) freedoms.value = usualFreedoms(settings.peek());
    setAsking(!asking);
  };
  return (
    <div class="placement">
      <button type="button" aria-expanded={asking} onClick={toggle}>
        Find a set-up
      </button>
      {asking && <PlacementForm />}
      <InquiryProgress inquiry={placing} name="the search for a set-up" />
      {found && <Answer answer={found.answer} />}
    </div>
  );
}

function Answer({ answer }: { answer: Placement }) {
  const state = standing.value;
  const runs = answer.verdict === "ok";
  return (
    <div role="region" aria-label="The set-up that was found" data-testid="placement" class="found">
      <Comparison answer={answer} />
      {state === "outdated" && (
        <p class="verdict">
          <span class="tag warn">outdated</span> It was found for other settings.
        </p>
      )}
      {!runs && (
        <p class="trouble">
          No set-up was found within these bounds with which the machine can run the program.
        </p>
      )}
      <p class="row">
        {state === "used" ? (
          <span class="quiet" role="status">
            This set-up is in use.
          </span>
        ) : (
          <button type="button" class="small" onClick={usePlacement}>
            Use this set-up
          </button>
        )}
        <button type="button" class="small" onClick={() => placing.forget()}>
          Discard
        </button>
      </p>
      <Limiting answer={answer} />
      <p class="hint">{guaranteeWords(answer.guarantee, answer.rows, answer.given.within_bounds)}</p>
    </div>
  );
}

function Comparison({ answer }: { answer: Placement }) {
  const given = givenRequest.value;
  const { setup, given: before, verdict, t, tool_length: length } = answer;
  const values = (["x", "y", "z", "a", "b", "c"] as const).flatMap((axis) => {
    const [from, to] = [given?.setup?.[axis] ?? 0, setup[axis] ?? 0];
    const words = axis === "a" || axis === "b" || axis === "c" ? degrees : mm;
    // Rotations that are nothing on both sides say nothing.
    return words === degrees && from === 0 && to === 0
      ? []
      : [{ name: axis.toUpperCase(), from: words(from), to: words(to) }];
  });
  const givenLength = given?.tool_length;
  if (length != null && typeof givenLength === "number")
    values.push({ name: "Tool", from: mm(givenLength), to: mm(length) });
  const runs = (ok: boolean) => <span class={ok ? "tag good" : "tag bad"}>{ok ? "runs" : "fails"}</span>;
  return (
    <table class="comparison">
      <thead>
        <tr>
          <td />
          <th scope="col">before</th>
          <th scope="col">after</th>
        </tr>
      </thead>
      <tbody>
        <tr>
          <th scope="row">Program</th>
          <td>{runs(before.verdict === "ok")}</td>
          <td>{runs(verdict === "ok")}</td>
        </tr>
        <tr>
          <th scope="row">Keeps</th>
          <td>{reserveWords(before.t)}</td>
          <td>{reserveWords(t)}</td>
        </tr>
        {values.map(({ name, from, to }) => (
          <tr key={name}>
            <th scope="row">{name}</th>
            <td>{from}</td>
            <td>{from === to ? to : <b>{to}</b>}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

function Limiting({ answer: { active } }: { answer: Placement }) {
  if (active.length === 0) return null;
  return (
    <>
      <h3 id="limiting">Limited by</h3>
      <ol class="failures limiting" aria-labelledby="limiting">
        {active.slice(0, MOST).map((margin) => (
          <li key={`${margin.line} ${margin.constraint} ${margin.element}`}>
            <button type="button" class="failure-line" onClick={() => showLine(margin.line)}>
              {activeWords(margin)}
            </button>
          </li>
        ))}
      </ol>
      {active.length > MOST && <p class="hint">… and {active.length - MOST} other margins.</p>}
    </>
  );
}
