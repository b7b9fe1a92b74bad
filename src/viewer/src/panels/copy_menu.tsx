/** Copies what is shown: as a link, as JSON, or as a command. */

import { useRef, useState } from "preact/hooks";
import { inWords } from "../api/client";
import { textOf, type Copy } from "../state/copies";
import { failure } from "../state/store";

const COPIES: readonly (readonly [Copy, string])[] = [
  ["link", "Link to this view"],
  ["pose", "Pose as JSON"],
  ["pose-command", "Pose as a curl command"],
  ["workspace-command", "Workspace as a curl command"],
];

export function CopyMenu() {
  const menu = useRef<HTMLDetailsElement>(null);
  const [copied, setCopied] = useState<string | null>(null);
  const copy = async (kind: Copy, name: string) => {
    try {
      const text = await textOf(kind);
      if (text !== null) await navigator.clipboard.writeText(text);
      setCopied(text === null ? "Nothing to copy yet" : `Copied: ${name}`);
      if (menu.current) menu.current.open = false;
      menu.current?.querySelector("summary")?.focus();
    } catch (thrown) {
      failure.value = { sentence: `The text was not copied: ${inWords(thrown)}`, remedy: null };
    }
  };
  return (
    <div class="copy">
      <details
        ref={menu}
        class="menu"
        onToggle={(event) => event.currentTarget.open && setCopied(null)}
        onFocusOut={(event) => {
          const { currentTarget: own, relatedTarget } = event;
          if (!(relatedTarget instanceof Node && own.contains(relatedTarget))) own.open = false;
        }}
        onKeyDown={(event) => {
          if (event.key === "Escape") event.currentTarget.open = false;
        }}
      >
        <summary class="button">Copy</summary>
        <div class="items">
          {COPIES.map(([kind, name]) => (
            <button key={kind} type="button" onClick={() => void copy(kind, name)}>
              {name}
            </button>
          ))}
        </div>
      </details>
      <span class="done" role="status">
        {copied}
      </span>
    </div>
  );
}
