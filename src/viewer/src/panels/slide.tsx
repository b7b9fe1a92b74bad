/** A number to slide, to jog and to type, with the ends of its travel, its home and the way that limits leave it. */

import { useEffect, useRef } from "preact/hooks";
import type { Way } from "../state/ways";
import { clamp } from "../state/joints";
import { number } from "../words/numbers";
import { clean, NumberField, spoken, type NumberProps } from "./fields";

interface SlideProps extends NumberProps {
  min: number;
  max: number;
  /** The greatest value that can be typed, where it is more than can be slid. */
  most?: number;
  /** By how much a press of a key or of a jog button moves it. */
  step: number;
  home?: number;
  way?: Way | undefined;
  /** Moves it from where it is wanted, which may be ahead of `value`. */
  nudge: (by: number) => void;
}

/** The step of a slide by the pointer. */
const FINE = 0.1;
const KEYS: Record<string, number> = {
  ArrowRight: 1,
  ArrowUp: 1,
  ArrowLeft: -1,
  ArrowDown: -1,
  PageUp: 10,
  PageDown: -10,
};

export function SlideField(props: SlideProps) {
  const { label, symbol = label, unit, value, min, max, most = max, decimals = 1, step, home, way } = props;
  const jogWithKeys = (event: KeyboardEvent) => {
    const steps = KEYS[event.key];
    if (steps === undefined) return;
    event.preventDefault();
    props.nudge(steps * step);
  };
  return (
    <div class="slide">
      <NumberField {...props} label={`${label}, typed`} symbol={symbol} max={most} />
      <Jog label={label} unit={unit} by={-step} nudge={props.nudge} />
      <Jog label={label} unit={unit} by={step} nudge={props.nudge} />
      <div class="travel">
        <span class="end" aria-hidden="true">
          {number(min, 0)}
        </span>
        <span class="rail">
          <Scale min={min} max={max} home={home} way={way} unit={unit} />
          <input
            type="range"
            aria-label={`${label}, ${spoken(unit)}`}
            min={min}
            max={max}
            step={FINE}
            value={clamp(value, min, max)}
            aria-valuetext={`${clean(value, decimals)} ${spoken(unit)}`}
            title={way ? wayInWords(way, unit) : undefined}
            onInput={(event) => props.commit(event.currentTarget.valueAsNumber)}
            onKeyDown={jogWithKeys}
          />
        </span>
        <span class="end" aria-hidden="true">
          {number(max, 0)}
        </span>
      </div>
    </div>
  );
}

interface JogProps {
  label: string;
  unit: string;
  by: number;
  nudge: (by: number) => void;
}

/** How long a button is held before it repeats, and how often then, ms. */
const HELD = 400;
const AGAIN = 90;

function Jog({ label, unit, by, nudge }: JogProps) {
  const timer = useRef(0);
  const stop = () => clearTimeout(timer.current);
  useEffect(() => stop, []);
  const repeat = (after: number) => {
    timer.current = window.setTimeout(() => {
      nudge(by);
      repeat(AGAIN);
    }, after);
  };
  const words = `${by < 0 ? "minus" : "plus"} ${Math.abs(by)} ${spoken(unit)}`;
  return (
    <button
      type="button"
      class="jog"
      aria-label={`${label}: ${words}`}
      title={words}
      onPointerDown={() => repeat(HELD)}
      onPointerUp={stop}
      onPointerLeave={stop}
      onPointerCancel={stop}
      onClick={() => nudge(by)}
    >
      {by < 0 ? "−" : "+"}
    </button>
  );
}

interface ScaleProps {
  min: number;
  max: number;
  home: number | undefined;
  way: Way | undefined;
  unit: string;
}

/** Behind the slider: the way that the limits leave, and a mark at home. */
function Scale({ min, max, home, way }: ScaleProps) {
  const at = (value: number) => (100 * (clamp(value, min, max) - min)) / (max - min || 1);
  return (
    <svg class="scale" viewBox="0 0 100 10" preserveAspectRatio="none" aria-hidden="true">
      {way && (
        <rect class="way" x={at(way.low.at)} y="1" width={at(way.high.at) - at(way.low.at)} height="8" />
      )}
      {home !== undefined && <rect class="home" x={at(home) - 0.5} y="0" width="1" height="10" />}
    </svg>
  );
}

/** Alone, it can go from here to there; and what ends its way. */
function wayInWords({ low, high }: Way, unit: string): string {
  const place = ({ at, limit }: Way["low"]) =>
    `${number(at)}${unit === "°" ? "" : " "}${unit}${limit ? ` (${limit})` : ""}`;
  return `Alone, it can move from ${place(low)} to ${place(high)}.`;
}
