/** Over the scene: of which tool and angles the workspace is that the scene shows. */

import { outdated } from "../state/computation";
import { computing, position, tool, wanted, workspace } from "../state/store";
import { degrees, mm } from "../words/numbers";

export function WorkspaceCaption() {
  const found = workspace.value;
  if (!found || !wanted.value.shown) return null;
  return (
    <p class={outdated.value ? "caption stale" : "caption"} data-testid="caption">
      {outdated.value && (
        <strong>{computing.value ? "Outdated, the new one is being computed: " : "Outdated: "}</strong>
      )}
      {subject(found.request)}
      {!outdated.value && stance(found.request)}
    </p>
  );
}

type Asked = NonNullable<typeof workspace.value>["request"];

function subject({ kind, tool_length: length, phi1, phi2 }: Asked): string {
  if (kind === "platform") return "Workspace of the platform’s point P";
  const tool = `tool ${number(length)}`;
  if (kind === "tool") return `Workspace of the tool tip, ${tool}`;
  return `Workspace on the part, ${tool}, φ₁ ${angle(phi1)}, φ₂ ${angle(phi2)}`;
}

/** How the machine differs from the workspace, if it does. */
function stance({ kind, phi1, phi2 }: Asked): string {
  const part = position.value?.solution.part;
  if (kind !== "part" || !part) return "";
  const same = angle(phi1) === angle(part.phi1) && angle(phi2) === angle(part.phi2);
  return same ? "" : `. The machine stands at φ₁ ${angle(part.phi1)}, φ₂ ${angle(part.phi2)}`;
}

function angle(value: unknown): string {
  return degrees(typeof value === "number" ? value : 0);
}

function number(value: unknown): string {
  return mm(typeof value === "number" ? value : tool.value);
}
