/** The schema of a machine, as the service publishes it: what fields mean, and what is wrong with their types. */

import { verne } from "../api/client";
import type { FieldFaults } from "../api/faults";

/** The part of JSON Schema that the machine's schema uses. */
export interface Schema {
  type?: string | string[];
  description?: string;
  properties?: Record<string, Schema>;
  required?: string[];
  additionalProperties?: boolean;
  items?: Schema;
  minItems?: number;
  maxItems?: number;
  minimum?: number;
  maximum?: number;
  oneOf?: Schema[];
}

let loading: Promise<Schema> | null = null;

export function machineSchema(): Promise<Schema> {
  loading ??= verne
    .file("/machines/schema")
    .then((bytes) => JSON.parse(new TextDecoder().decode(bytes)) as Schema)
    .catch((thrown: unknown) => {
      loading = null;
      throw thrown;
    });
  return loading;
}

/** The schema of a field, by its pointer without the leading slash. */
export function fieldSchema(schema: Schema, pointer: string): Schema | null {
  let found: Schema | undefined = schema;
  for (const name of pointer.split("/")) {
    const whole: Schema | undefined = found && given(found);
    found = whole?.properties?.[name] ?? whole?.items;
  }
  return found ? given(found) : null;
}

/** All faults of types, of missing and of unknown fields; what values a machine may have is for the service to say. */
export function typeFaults(value: unknown, schema: Schema, pointer = ""): FieldFaults {
  const alternatives = schema.oneOf ?? [schema];
  if (value === null && alternatives.some((one) => types(one).includes("null"))) return {};
  const wanted = given(schema);
  const expected = types(wanted).filter((name) => name !== "null");
  if (expected.length > 0 && !expected.includes(typeOf(value)))
    return { [pointer]: `must be ${expected.map(inWords).join(" or ")}, not ${inWords(typeOf(value))}` };
  const at = (name: string | number) => (pointer === "" ? String(name) : `${pointer}/${name}`);
  if (Array.isArray(value)) {
    const { minItems = 0, maxItems = Infinity, items } = wanted;
    if (value.length < minItems || value.length > maxItems)
      return {
        [pointer]: `must have ${minItems === maxItems ? minItems : `${minItems} to ${maxItems}`} entries, not ${value.length}`,
      };
    const found = value.map((item: unknown, i) => (items ? typeFaults(item, items, at(i)) : {}));
    return Object.assign({}, ...found) as FieldFaults;
  }
  if (typeof value !== "object" || value === null) return {};
  const { properties = {}, required = [], additionalProperties = true } = wanted;
  const missing = required.filter((name) => !(name in value)).map((name) => ({ [at(name)]: "is missing" }));
  const present = Object.entries(value).map(([name, item]) => {
    const known = properties[name];
    if (known) return typeFaults(item, known, at(name));
    return additionalProperties ? {} : { [at(name)]: "is no field of a machine" };
  });
  return Object.assign({}, ...missing, ...present) as FieldFaults;
}

/** The alternative of a schema that is not null. */
function given(schema: Schema): Schema {
  return schema.oneOf?.find((one) => !types(one).includes("null")) ?? schema;
}

function types({ type = [] }: Schema): string[] {
  return typeof type === "string" ? [type] : type;
}

function typeOf(value: unknown): string {
  if (value === null) return "null";
  return Array.isArray(value) ? "array" : typeof value;
}

function inWords(type: string): string {
  const words: Record<string, string> = {
    number: "a number",
    string: "a text",
    boolean: "true or false",
    array: "a list",
    object: "an object",
    null: "null",
  };
  return words[type] ?? type;
}
