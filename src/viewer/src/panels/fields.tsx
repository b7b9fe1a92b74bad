/** Numbers to type and to slide. */

import { tooltip } from "../words/symbols";
import { useEffect, useId, useRef, useState } from "preact/hooks";

export interface NumberProps {
  label: string;
  /** Shown instead of the label, which remains for those who listen. */
  symbol?: string;
  unit: string;
  value: number;
  decimals?: number;
  step?: number;
  min?: number;
  max?: number;
  /** Why the value cannot be used; empty where another element says it. */
  fault?: string | undefined;
  commit: (value: number) => void;
}

/** A number with its unit; while it is typed, nothing overwrites it. A value out of range stays, with its reason. */
export function NumberField({
  label,
  symbol,
  unit,
  value,
  decimals = 1,
  step = 1,
  min = -Infinity,
  max = Infinity,
  fault,
  commit,
}: NumberProps) {
  const input = useRef<HTMLInputElement>(null);
  const id = useId();
  const [typing, setTyping] = useState(false);
  const [outOfRange, setOutOfRange] = useState(false);
  const shown = clean(value, decimals);
  useEffect(() => setOutOfRange(false), [shown]);
  useEffect(() => {
    if (!typing && !outOfRange && input.current) input.current.value = shown;
  }, [shown, typing, outOfRange]);
  const take = () => {
    const typed = input.current?.valueAsNumber ?? Number.NaN;
    const inside = !(typed < min || typed > max);
    setOutOfRange(!inside);
    if (inside && Number.isFinite(typed) && input.current?.value !== shown) commit(typed);
  };
  const discard = (event: KeyboardEvent) => {
    if (event.key !== "Escape" || !input.current) return;
    input.current.value = shown;
    setOutOfRange(false);
  };
  const words = outOfRange ? range(min, max, unit) : fault;
  return (
    <label class="number">
      <span class="name" title={tooltip(symbol ?? label)} aria-hidden={symbol ? "true" : undefined}>
        {symbol ?? label}
      </span>
      <span class="box">
        <input
          ref={input}
          type="number"
          inputMode="decimal"
          aria-label={symbol ? `${label}, ${spoken(unit)}` : undefined}
          aria-invalid={words !== undefined}
          aria-describedby={words ? id : undefined}
          step={step}
          defaultValue={shown}
          onFocus={() => setTyping(true)}
          onBlur={() => setTyping(false)}
          onChange={take}
          onKeyDown={discard}
        />
        <span class="unit" aria-hidden="true">
          {unit}
        </span>
      </span>
      {words && (
        <span class="fault" id={id} role="alert">
          {symbol ?? label}: {words}
        </span>
      )}
    </label>
  );
}

/** The values that a field takes, in words. */
function range(min: number, max: number, unit: string): string {
  const space = unit === "°" ? "" : "\u00a0";
  if (max === Infinity) return `at least ${min}${space}${unit}`;
  if (min === -Infinity) return `at most ${max}${space}${unit}`;
  return `from ${min} to ${max}${space}${unit}`;
}

interface ChoiceProps<T extends string> {
  legend: string;
  name: string;
  value: T;
  options: readonly (readonly [T, string])[];
  choose: (value: T) => void;
}

/** One of a few: radio buttons that look like one switch. */
export function Choice<T extends string>({ legend, name, value, options, choose }: ChoiceProps<T>) {
  return (
    <fieldset class="choice">
      <legend class="quiet">{legend}</legend>
      <div class="switch">
        {options.map(([option, text]) => (
          <label key={option}>
            <input type="radio" name={name} checked={option === value} onChange={() => choose(option)} />
            <span>{text}</span>
          </label>
        ))}
      </div>
    </fieldset>
  );
}

export function clean(value: number, decimals: number): string {
  return (Number(value.toFixed(decimals)) + 0).toFixed(decimals);
}

/** A unit as it is read aloud. */
export function spoken(unit: string): string {
  return unit === "°" ? "degrees" : unit;
}
