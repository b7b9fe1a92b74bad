/** A machine's file that is none: every field, and what is wrong with it beside it. */

import { useEffect, useRef } from "preact/hooks";
import { rejected, type Rejected } from "./machine_file";

export function MachineFaults() {
  const dialog = useRef<HTMLDialogElement>(null);
  const file = rejected.value;
  useEffect(() => {
    if (file && !dialog.current?.open) {
      dialog.current?.showModal();
      dialog.current?.querySelector("tr.bad")?.scrollIntoView({ block: "center" });
    }
    if (!file) dialog.current?.close();
  }, [file]);
  return (
    <dialog ref={dialog} aria-labelledby="faults" onClose={() => (rejected.value = null)}>
      {file && <Faults file={file} />}
    </dialog>
  );
}

function Faults({ file }: { file: Rejected }) {
  const fields = leaves(file.content);
  const astray = file.faults.filter(({ pointer }) => !fields.some((field) => at(field.pointer, pointer)));
  return (
    <>
      <h2 id="faults">{file.file} makes no machine</h2>
      <p>{file.faults.length > 0 ? "What cannot be used is marked, with what would be." : file.summary}</p>
      {astray.map((fault) => (
        <p class="trouble" key={fault.pointer}>
          <code>{fault.pointer || "the whole file"}</code> {fault.detail}
        </p>
      ))}
      {fields.length > 0 && (
        <div class="fields" tabIndex={0} role="region" aria-label="Fields of the file">
          <table>
            <tbody>
              {fields.map(({ pointer, value }) => {
                const faults = file.faults.filter((fault) => at(pointer, fault.pointer));
                return (
                  <tr key={pointer} class={faults.length > 0 ? "bad" : ""}>
                    <th scope="row">{pointer.slice(1).replaceAll("/", " › ")}</th>
                    <td class="value">{value}</td>
                    <td>{faults.map(({ detail }) => detail).join("; ")}</td>
                  </tr>
                );
              })}
            </tbody>
          </table>
        </div>
      )}
      <p class="hint">
        The machine on the page has not changed. <a href="machines/schema">The schema of a machine</a>
      </p>
      <button type="button" onClick={() => (rejected.value = null)}>
        Close
      </button>
    </>
  );
}

interface Leaf {
  pointer: string;
  value: string;
}

/** The fields with a value of their own; short lists of numbers are one. */
function leaves(value: unknown, pointer = ""): Leaf[] {
  if (Array.isArray(value) && value.every((item) => typeof item !== "object"))
    return [{ pointer, value: `[${value.join(", ")}]` }];
  if (typeof value !== "object" || value === null)
    return pointer === "" ? [] : [{ pointer, value: JSON.stringify(value) }];
  return Object.entries(value).flatMap(([name, item]) =>
    leaves(item, `${pointer}/${name.replaceAll("~", "~0").replaceAll("/", "~1")}`),
  );
}

/** Whether a fault concerns this field: it, or an item of its list. */
function at(field: string, fault: string): boolean {
  return fault === field || fault.startsWith(`${field}/`);
}
