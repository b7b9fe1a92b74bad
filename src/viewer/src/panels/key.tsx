/** Asks for the service's key. */

import { useEffect, useRef } from "preact/hooks";
import { wanted, type Wanted } from "../api/key";

export function KeyDialog() {
  const dialog = useRef<HTMLDialogElement>(null);
  const asked = wanted.value;
  useEffect(() => {
    if (asked && !dialog.current?.open) dialog.current?.showModal();
    if (!asked) dialog.current?.close();
  }, [asked]);
  return (
    <dialog ref={dialog} aria-labelledby="key-wanted" onCancel={() => asked?.answer(null)}>
      {asked && <KeyForm asked={asked} />}
    </dialog>
  );
}

function KeyForm({ asked }: { asked: Wanted }) {
  const input = useRef<HTMLInputElement>(null);
  return (
    <form
      onSubmit={(event) => {
        event.preventDefault();
        asked.answer(input.current?.value ?? null);
      }}
    >
      <h2 id="key-wanted">This service asks for a key</h2>
      {asked.refused && (
        <p class="trouble" role="alert">
          The key that was sent is not known here.
        </p>
      )}
      <p class="row">
        <input
          ref={input}
          class="key"
          type="password"
          aria-label="Key"
          autocomplete="off"
          pattern="[!-~]+"
          required
        />
        <button type="submit">Go on</button>
        <button type="button" onClick={() => asked.answer(null)}>
          Cancel
        </button>
      </p>
      <p class="hint">It is kept until this tab is closed.</p>
    </form>
  );
}
