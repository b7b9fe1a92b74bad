/** Buttons that play the program, and the bar of its time. */

import { effect } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { isDark, marginColour, onTheme } from "./colours";
import { clock, count } from "./failure_words";
import { pause, play, seek, seekRow, step } from "./player";
import {
  currentLine,
  currentRow,
  dockOpen,
  duration,
  failing,
  framing,
  loop,
  now,
  plan,
  playing,
  speed,
  type Plan,
} from "./program_state";

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10, 20, 50, 100];

export function Transport() {
  const found = plan.value;
  const last = found ? found.rows.count - 1 : 0;
  const on = playing.value;
  return (
    <div class="transport">
      <div class="buttons" role="group" aria-label="Play the program">
        <Button name="To the start" sign="start" press={() => seekRow(0)} />
        <Button name="One row back" sign="back" press={() => step(-1)} />
        <Button
          name={on ? "Pause" : "Play"}
          sign={on ? "pause" : "play"}
          press={() => (on ? pause() : play())}
          main
        />
        <Button name="One row on" sign="on" press={() => step(1)} />
        <Button name="To the end" sign="end" press={() => seekRow(last)} />
      </div>
      <label class="speed">
        <span class="quiet">Speed</span>
        <select
          aria-label="Speed"
          value={String(speed.value)}
          onChange={(event) => (speed.value = Number(event.currentTarget.value))}
        >
          {SPEEDS.map((value) => (
            <option key={value} value={String(value)}>
              {value} ×
            </option>
          ))}
        </select>
      </label>
      <label class="check">
        <input
          type="checkbox"
          checked={loop.value}
          onChange={(event) => (loop.value = event.currentTarget.checked)}
        />
        loop
      </label>
      {failing.value.length > 0 && (
        <div class="buttons" role="group" aria-label="Failing stretches">
          <Button name="Failing stretch before" sign="failing before" press={() => toFailing(-1)} />
          <Button name="Next failing stretch" sign="failing after" press={() => toFailing(1)} />
        </div>
      )}
      <button type="button" onClick={() => (framing.value += 1)}>
        Look at the path
      </button>
      <button
        type="button"
        aria-expanded={dockOpen.value}
        onClick={() => (dockOpen.value = !dockOpen.peek())}
      >
        Text and plots
      </button>
      <output class="where" data-testid="where">
        <b>line {count(currentLine.value)}</b>
        <span>
          row {count((found?.rows.number[currentRow.value] ?? 0) + 1)} of {count(found?.report.rows ?? 0)}
        </span>
        <span>
          {clock(now.value)} of {clock(duration.value)}
        </span>
      </output>
    </div>
  );
}

/** Shapes of the buttons in a square of 16. */
const SIGNS = {
  start: "M3 3h2v10H3zM13 3v10L6 8z",
  back: "M11 3v10L4 8z",
  play: "M4 2v12l10-6z",
  pause: "M4 3h3v10H4zM9 3h3v10H9z",
  on: "M5 3v10l7-5z",
  end: "M11 3h2v10h-2zM3 3v10l7-5z",
  "failing before": "M6 3v10L0 8zM10 2h3l-.6 8h-1.8zM10.2 11.5h2.6V14h-2.6z",
  "failing after": "M10 3v10l6-5zM3 2h3l-.6 8H3.6zM3.2 11.5h2.6V14H3.2z",
};

interface ButtonProps {
  name: string;
  sign: keyof typeof SIGNS;
  press: () => void;
  main?: boolean;
}

function Button({ name, sign, press, main }: ButtonProps) {
  return (
    <button type="button" class={main ? "main" : ""} aria-label={name} title={name} onClick={press}>
      <svg viewBox="0 0 16 16" aria-hidden="true">
        <path d={SIGNS[sign]} />
      </svg>
    </button>
  );
}

/** To the worst row of the next stretch that breaks a limit. */
function toFailing(direction: 1 | -1): void {
  const { time, rows } = plan.peek() ?? {};
  if (!time || !rows) return;
  const worst = failing.peek().map(([from, to]) => {
    let best = -1;
    for (let row = 0; row < time.length; row += 1) {
      const at = time[row] ?? 0;
      if (at < from || at > to) continue;
      if (best < 0 || (rows.fraction[row] ?? 0) < (rows.fraction[best] ?? 0)) best = row;
    }
    return time[best] ?? from;
  });
  const at = now.peek();
  const next =
    direction === 1 ? worst.find((seconds) => seconds > at) : worst.findLast((seconds) => seconds < at);
  const around = direction === 1 ? worst[0] : worst.at(-1);
  seek(next ?? around ?? at);
}

/** The time of the program as a bar with the colours of the worst margin. */
export function TimeBar() {
  const strip = useRef<HTMLCanvasElement>(null);
  const end = duration.value;
  useEffect(() => {
    const canvas = strip.current;
    if (!canvas) return;
    const paint = () => drawStrip(canvas, plan.peek());
    const stopPlan = effect(() => {
      if (plan.value) paint();
    });
    const stopTheme = onTheme(paint);
    const sizes = new ResizeObserver(paint);
    sizes.observe(canvas);
    return () => {
      stopPlan();
      stopTheme();
      sizes.disconnect();
    };
  }, []);
  const spoken = `line ${currentLine.value}, ${now.value.toFixed(1)} of ${end.toFixed(1)} seconds`;
  return (
    <div class="time-bar">
      <canvas ref={strip} aria-hidden="true" />
      <input
        type="range"
        aria-label="Time in the program, seconds"
        aria-valuetext={spoken}
        min={0}
        max={end}
        step="any"
        value={now.value}
        onInput={(event) => seek(event.currentTarget.valueAsNumber)}
        onKeyDown={(event) => {
          const by = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
          if (by === 1 || by === -1) step(by);
          else if (event.key === " ") (playing.peek() ? pause : play)();
          else return;
          event.preventDefault();
        }}
      />
    </div>
  );
}

/** Each pixel has the colour of the worst row in its time. */
function drawStrip(canvas: HTMLCanvasElement, found: Plan | null): void {
  const width = Math.max(Math.round(canvas.clientWidth * devicePixelRatio), 1);
  const height = Math.max(Math.round(canvas.clientHeight * devicePixelRatio), 1);
  canvas.width = width;
  canvas.height = height;
  const context = canvas.getContext("2d");
  if (!context || !found || found.rows.count === 0) return;
  const { time, rows } = found;
  const end = time.at(-1) || 1;
  const worst = new Float64Array(width).fill(Infinity);
  for (let row = 0; row < rows.count; row += 1) {
    const from = Math.floor(((time[Math.max(row - 1, 0)] ?? 0) / end) * (width - 1));
    const to = Math.floor(((time[row] ?? 0) / end) * (width - 1));
    for (let pixel = from; pixel <= to; pixel += 1)
      worst[pixel] = Math.min(worst[pixel] ?? Infinity, rows.fraction[row] ?? 0);
  }
  for (const [from, to] of failing.peek()) {
    const [first, last] = [from, to].map((seconds) => Math.floor((seconds / end) * (width - 1)));
    // A stretch of the program is at least as wide as it must be to be seen.
    for (let pixel = first ?? 0; pixel <= Math.max(last ?? 0, (first ?? 0) + 2); pixel += 1)
      if (!((worst[pixel] ?? 0) < 0)) worst[pixel] = -1;
  }
  const dark = isDark();
  worst.forEach((fraction, pixel) => {
    context.fillStyle = `rgb(${marginColour(fraction, dark).join(" ")})`;
    // Failing stretches are higher than the others, so that they stand out without their colour.
    const top = fraction < 0 ? 0 : height * 0.3;
    context.fillRect(pixel, top, 1, height - 2 * top);
  });
}
