/** Why the machine did not go where a panel sent it. */

import { refusal } from "../state/store";

interface Props {
  /** What the panel sets. */
  by: "joints" | "pose";
  /** Shown where nothing was refused. */
  children?: string;
}

export function Refused({ by, children }: Props) {
  const refused = refusal.value;
  const here = refused && (refused.target.by === "joints") === (by === "joints") ? refused : null;
  if (!here && !children) return <div role="status" />;
  return (
    <div class="row between" role="status">
      <p class={here ? "trouble" : "hint"} data-testid={by === "joints" ? "joints-trouble" : "trouble"}>
        {here ? here.sentence : children}
      </p>
      {here && (
        <button type="button" class="small" onClick={() => (refusal.value = null)}>
          Discard
        </button>
      )}
    </div>
  );
}
