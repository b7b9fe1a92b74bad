/** Where the program runs: a slider for each parameter that is asked about, with its windows as marks. */

import type { Schemas, Window } from "verne-client";
import { degrees, mm, number } from "../words/numbers";
import { InquiryProgress } from "./inquiry_progress";
import { showLine } from "./player";
import { settings, type OpenProgram } from "./program_state";
import { hasOneLength, WINDOW_NAMES, type WindowName } from "./window_range";
import { endWords, intervalWords, noWindowWords, windowGuarantee } from "./window_words";
import { askWindow, setValue, valueNow, windows, type AskedWindow } from "./windows";

const NAMES: Record<WindowName, { symbol: string; spoken: string }> = {
  "setup.x": { symbol: "X", spoken: "x of the set-up" },
  "setup.y": { symbol: "Y", spoken: "y of the set-up" },
  "setup.z": { symbol: "Z", spoken: "z of the set-up" },
  "setup.c": { symbol: "C", spoken: "turn of the set-up about z" },
  tool_length: { symbol: "Length", spoken: "length of the tool" },
};

export function WindowBars({ open }: { open: OpenProgram }) {
  const one = hasOneLength(open.summary.tools, settings.value);
  const usable = WINDOW_NAMES.filter((name) => name !== "tool_length" || one);
  return (
    <div class="windows" role="group" aria-labelledby="windows">
      <p class="quiet" id="windows">
        Where does it run?
      </p>
      <p class="row ask">
        {usable.map((name) => (
          <Ask key={name} name={name} />
        ))}
      </p>
      {usable.map((name) => (
        <OneWindow key={name} name={name} />
      ))}
    </div>
  );
}

function Ask({ name }: { name: WindowName }) {
  const { inquiry } = windows[name];
  const { symbol, spoken } = NAMES[name];
  const shown = inquiry.found.value !== null || inquiry.activity.value !== null;
  return (
    <button
      type="button"
      class="small"
      aria-pressed={shown}
      aria-label={`Where does it run: ${spoken}`}
      title={`The values of the ${spoken} with which the program runs`}
      onClick={() => (shown ? inquiry.forget() : askWindow(name))}
    >
      {symbol}
    </button>
  );
}

function OneWindow({ name }: { name: WindowName }) {
  const { inquiry, outdated } = windows[name];
  const found = inquiry.found.value;
  const { symbol, spoken } = NAMES[name];
  return (
    <>
      {found && (
        <div class="window" role="region" aria-label={`Window: ${spoken}`}>
          <Slider name={name} asked={JSON.parse(found.asked) as AskedWindow} answer={found.answer} />
          {outdated.value ? (
            <p class="verdict">
              <span class="tag warn">outdated</span> {symbol}: these were the windows of other settings.{" "}
              <button type="button" class="small" onClick={() => askWindow(name)}>
                Look again
              </button>
            </p>
          ) : (
            <InWords name={name} answer={found.answer} />
          )}
        </div>
      )}
      <InquiryProgress inquiry={inquiry} name={`the window, ${spoken}`} />
    </>
  );
}

interface SliderProps {
  name: WindowName;
  asked: AskedWindow;
  answer: Window;
}

function Slider({ name, asked: { from, to }, answer }: SliderProps) {
  const value = valueNow(name);
  const { symbol, spoken } = NAMES[name];
  const words = answer.unit === "deg" ? degrees(value) : mm(value);
  const old = windows[name].outdated.value;
  const inside = answer.intervals.some((interval) => interval.from <= value && value <= interval.to);
  const said = old ? "" : inside ? ", the program runs" : ", the program fails";
  const at = (place: number) => ((place - from) / (to - from)) * 100;
  return (
    <>
      <p class="row between">
        <span>
          <b>{symbol}</b> {words}
        </span>
      </p>
      <div class="time-bar">
        <svg viewBox="0 0 100 1" preserveAspectRatio="none" aria-hidden="true">
          <rect class="outside" width="100" height="1" />
          {answer.intervals.map((interval) => (
            <rect
              key={interval.from}
              class={old ? "old" : "inside"}
              x={at(interval.from)}
              width={Math.max(at(interval.to) - at(interval.from), 0.5)}
              height="1"
            />
          ))}
        </svg>
        <input
          type="range"
          aria-label={`${spoken}, with its windows`}
          min={from}
          max={to}
          step={0.1}
          value={value}
          aria-valuetext={`${words}${said}`}
          onInput={(event) => setValue(name, event.currentTarget.valueAsNumber)}
        />
      </div>
      <p class="row between quiet" aria-hidden="true">
        <span>{number(from, 0)}</span>
        <span>{number(to, 0)}</span>
      </p>
    </>
  );
}

function InWords({ name, answer }: { name: WindowName; answer: Window }) {
  const { intervals, unit, nearest, request } = answer;
  if (intervals.length === 0) return <p class="trouble">{noWindowWords(request, unit, nearest)}</p>;
  return (
    <>
      <ol class="failures intervals" aria-label={`Windows: ${NAMES[name].spoken}`}>
        {intervals.map((interval) => (
          <li key={interval.from}>
            <span>{intervalWords(interval, unit)}</span>
            {(["below", "above"] as const).map((side, i) => {
              const end = interval.ends[i];
              return end && <End key={side} end={end} side={side} />;
            })}
            <button
              type="button"
              class="small"
              onClick={() => setValue(name, Number(((interval.from + interval.to) / 2).toFixed(3)))}
            >
              take its middle
            </button>
          </li>
        ))}
      </ol>
      <p class="hint">{windowGuarantee(answer)}</p>
    </>
  );
}

function End({ end, side }: { end: Schemas["WindowEnd"]; side: "below" | "above" }) {
  if (end.kind === "bound") return <span class="quiet">{endWords(end, side)}</span>;
  return (
    <button type="button" class="failure-line" onClick={() => showLine(end.line)}>
      {endWords(end, side)}
    </button>
  );
}
