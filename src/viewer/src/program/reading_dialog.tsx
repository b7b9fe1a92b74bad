/** Asks how to read a file: its format where the name does not tell, and what a refused file leaves open. */

import { useEffect, useRef } from "preact/hooks";
import { Choice, NumberField } from "../panels/fields";
import { count } from "./failure_words";
import { FORMAT_NAMES, FORMATS, type Format } from "./formats";
import { openProgram, waiting, type Reading, type Waiting } from "./open_program";

export function ReadingDialog() {
  const dialog = useRef<HTMLDialogElement>(null);
  const asked = waiting.value;
  const open = asked !== null;
  useEffect(() => {
    if (open && !dialog.current?.open) dialog.current?.showModal();
    if (!open) dialog.current?.close();
  }, [open]);
  return (
    <dialog ref={dialog} aria-labelledby="reading" onClose={() => (waiting.value = null)}>
      {asked && <Form asked={asked} />}
    </dialog>
  );
}

function Form({ asked }: { asked: Waiting }) {
  const { file, reading, refusal } = asked;
  const alter = (part: Partial<Reading>) => (waiting.value = { ...asked, reading: { ...reading, ...part } });
  return (
    <form
      onSubmit={(event) => {
        event.preventDefault();
        if (reading.format !== null) void openProgram(file, reading);
      }}
    >
      <h2 id="reading">{refusal ? `The service cannot read ${file.name}` : `What is ${file.name}?`}</h2>
      {refusal && <Faults refusal={refusal} />}
      <label class="row between format">
        <span class="quiet">Format</span>
        <select
          aria-label="Format of the file"
          value={reading.format ?? ""}
          onChange={(event) => alter({ format: (event.currentTarget.value || null) as Format | null })}
        >
          <option value="">choose …</option>
          {FORMATS.map((format) => (
            <option key={format} value={format}>
              {FORMAT_NAMES[format]}
            </option>
          ))}
        </select>
      </label>
      <Choice
        legend="Unit, if the file states none"
        name="reading-units"
        value={reading.units ?? "none"}
        options={[
          ["none", "leave open"],
          ["mm", "mm"],
          ["inch", "inch"],
        ]}
        choose={(units) => alter({ units: units === "none" ? null : units })}
      />
      {reading.format === "gcode" && <CentrePoint reading={reading} alter={alter} />}
      <p class="row">
        <button type="submit" disabled={reading.format === null}>
          {refusal ? "Read it again" : "Open"}
        </button>
        <button type="button" onClick={() => (waiting.value = null)}>
          Cancel
        </button>
      </p>
    </form>
  );
}

interface Options {
  reading: Reading;
  alter: (part: Partial<Reading>) => void;
}

/** Control of the tool centre point: each controller has its own codes for it. */
function CentrePoint({ reading, alter }: Options) {
  const codes = (label: string, name: "tcpOn" | "tcpOff", example: string) => (
    <label class="number">
      <span class="name">{label}</span>
      <input
        class="key"
        type="text"
        value={reading[name]}
        placeholder={example}
        onChange={(event) => alter({ [name]: event.currentTarget.value })}
      />
    </label>
  );
  return (
    <fieldset class="offset">
      <legend class="quiet">G-code</legend>
      <label class="check">
        <input
          type="checkbox"
          checked={reading.tcp}
          onChange={(event) => alter({ tcp: event.currentTarget.checked })}
        />
        X, Y, Z are always the tool’s end on the part (tool centre point control)
      </label>
      <div class="row three">
        {codes("Codes that begin it", "tcpOn", "M428")}
        {codes("Codes that end it", "tcpOff", "M429")}
        <NumberField
          label="Feeds from here on are rapids (0: none)"
          unit="mm/min"
          value={reading.rapidFeed ?? 0}
          decimals={0}
          min={0}
          step={1000}
          commit={(value) => alter({ rapidFeed: value > 0 ? value : null })}
        />
      </div>
      <Choice
        legend="A, B and C turn"
        name="reading-sense"
        value={reading.rotarySense}
        options={[
          ["tool", "the tool (ISO 841)"],
          ["table", "the table"],
        ]}
        choose={(rotarySense) => alter({ rotarySense })}
      />
    </fieldset>
  );
}

function Faults({ refusal }: { refusal: NonNullable<Waiting["refusal"]> }) {
  const { summary, faults, text } = refusal;
  if (faults.length === 0) return <p class="trouble">{summary}</p>;
  return (
    <>
      <p>
        {faults.length === 1
          ? "It has a fault:"
          : `It has faults; these are ${count(faults.length)} of them:`}
      </p>
      <ol class="faults" tabIndex={0} aria-label="Faults">
        {faults.map(({ line, column, word, detail }) => (
          <li key={`${line} ${column}`}>
            <b>line {count(line)}</b> <FaultyLine text={text?.line(line) ?? ""} column={column} word={word} />
            <span class="trouble">{detail}</span>
          </li>
        ))}
      </ol>
    </>
  );
}

/** The line with the word at fault marked; `column` counts bytes, which are characters in programs but for comments. */
function FaultyLine({ text, column, word }: { text: string; column: number; word: string }) {
  // The service may write the word in capitals.
  const [line, wanted] = [text.toLowerCase(), word.toLowerCase()];
  const from = line.startsWith(wanted, column - 1) ? column - 1 : line.indexOf(wanted);
  if (word === "" || from < 0) return <code>{text}</code>;
  return (
    <code>
      {text.slice(0, from)}
      <mark>{text.slice(from, from + word.length)}</mark>
      {text.slice(from + word.length)}
    </code>
  );
}
