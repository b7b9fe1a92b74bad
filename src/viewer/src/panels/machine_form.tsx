/** The machine's dimensions and limits, to be changed while it is seen, and its file. */

import { useEffect, useState } from "preact/hooks";
import type { FieldFaults } from "../api/faults";
import { discardDraft, draft, draftFaults, edit, numberLeaves, type NumberLeaf } from "../state/machine_edit";
import { fieldSchema, machineSchema, type Schema } from "../state/machine_schema";
import { machine } from "../state/store";
import { NumberField } from "./fields";
import { saveFile } from "./save_file";

const GROUPS = [
  ["geometry", "Dimensions, mm"],
  ["table", "Table, mm"],
  ["limits", "Limits, mm and degrees"],
  ["drives", "Drives"],
] as const;

export function MachineForm() {
  const [open, setOpen] = useState(false);
  const known = machine.value?.definition;
  if (!known) return null;
  const download = () =>
    saveFile(
      new Blob([`${JSON.stringify(known, null, 2)}\n`], { type: "application/json" }),
      `${known.name}.json`,
    );
  return (
    <section aria-labelledby="machine-form">
      <header>
        <h2 id="machine-form">Dimensions and limits</h2>
        <button type="button" class="small" onClick={download}>
          Download JSON
        </button>
      </header>
      <details onToggle={(event) => setOpen(event.currentTarget.open)}>
        <summary>Change them</summary>
        {open && <Form />}
      </details>
    </section>
  );
}

function Form() {
  const [schema, setSchema] = useState<Schema | null>(null);
  useEffect(() => {
    // Without the schema the fields lack tooltips only: the service checks all values.
    machineSchema().then(setSchema, () => undefined);
  }, []);
  const shown = draft.value ?? machine.value?.definition;
  if (!shown) return null;
  const faults = draftFaults.value;
  const leaves = numberLeaves(shown);
  const own = new Set(leaves.flatMap(({ pointer }) => [pointer, listOf(pointer)]));
  const others = Object.entries(faults).filter(([pointer]) => !own.has(pointer));
  return (
    <>
      {GROUPS.map(([group, title]) => {
        const fields = leaves.filter(({ pointer }) => pointer.startsWith(`${group}/`));
        if (fields.length === 0) return null;
        return (
          <fieldset key={group} class="dimensions">
            <legend class="quiet">{title}</legend>
            {fields.map((leaf) => (
              <Dimension
                key={leaf.pointer}
                leaf={leaf}
                schema={schema}
                fault={faultAt(faults, leaf.pointer)}
              />
            ))}
          </fieldset>
        );
      })}
      {others.map(([pointer, detail]) => (
        <p key={pointer} class="trouble" role="alert">
          {wordsOf(pointer)}: {detail}
        </p>
      ))}
      {Object.keys(faults).length > 0 && (
        <div class="row between">
          <p class="trouble">The machine on the page has not changed.</p>
          <button type="button" class="small" onClick={discardDraft}>
            Discard
          </button>
        </div>
      )}
    </>
  );
}

interface DimensionProps {
  leaf: NumberLeaf;
  schema: Schema | null;
  fault: string | undefined;
}

function Dimension({ leaf: { pointer, value }, schema, fault }: DimensionProps) {
  const known = schema && fieldSchema(schema, pointer);
  const words = wordsOf(pointer);
  // A number of a list is described by its list.
  const list = schema && fieldSchema(schema, pointer.replace(/(\/\d+)+$/, ""));
  return (
    <NumberField
      label={words}
      unit=""
      value={value}
      decimals={decimals(value)}
      min={known?.minimum ?? -Infinity}
      max={known?.maximum ?? Infinity}
      hint={known?.description ?? list?.description}
      fault={fault}
      commit={(next) => edit(pointer, next)}
    />
  );
}

/** The list that a number is an entry of. */
function listOf(pointer: string): string {
  return pointer.replace(/\/\d+$/, "");
}

/** A fault of a list stands at its first number; the others are marked. */
function faultAt(faults: FieldFaults, pointer: string): string | undefined {
  const list = listOf(pointer);
  if (list === pointer || faults[pointer] !== undefined) return faults[pointer];
  return faults[list] !== undefined && !pointer.endsWith("/0") ? "" : faults[list];
}

/** `limits/stroke/0/1` → "stroke 1 max". */
function wordsOf(pointer: string): string {
  const names = pointer.split("/").slice(1);
  const end = /^[01]$/.test(names.at(-1) ?? "") ? (names.pop() === "0" ? " min" : " max") : "";
  return (
    names.map((name) => (/^\d$/.test(name) ? Number(name) + 1 : name.replaceAll("_", " "))).join(" ") + end
  );
}

function decimals(value: number): number {
  const [, fraction = ""] = String(value).split(".");
  return Math.min(fraction.length, 6);
}
