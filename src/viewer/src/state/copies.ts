/** What the page shows as text for others: a link, JSON, or commands that ask the service the same. */

import { hasKey } from "../api/key";
import { link } from "./address_bar";
import { question } from "./computation";
import { forwardQuestion } from "./motion";
import { machine, position, view } from "./store";

export type Copy = "link" | "pose" | "pose-command" | "workspace-command";

/** The text; null where there is nothing to copy yet. */
export async function textOf(copy: Copy): Promise<string | null> {
  switch (copy) {
    case "link":
      return link();
    case "pose":
      return pose();
    case "pose-command": {
      const { joints, mode } = view.peek();
      return joints && command("fk", JSON.stringify(forwardQuestion(joints, mode)));
    }
    case "workspace-command": {
      const asked = question.peek();
      return asked === null ? null : command("workspace", asked);
    }
  }
}

function pose(): string | null {
  const at = position.peek();
  const known = machine.peek();
  if (!at || !known) return null;
  const { definition, hash } = known;
  const { tool } = view.peek();
  // The joints stand first; the solution of /ik has them, too.
  const { joints, solution } = at;
  return JSON.stringify(
    { machine: { name: definition.name, hash }, tool_length: tool, ...solution, joints },
    null,
    2,
  );
}

/** A command for a shell; with keys, it takes the key from the environment. */
export function command(path: string, body: string): string {
  const address = new URL(path, document.baseURI).href;
  const key = hasKey() ? ' -H "Authorization: Bearer $VERNE_KEY"' : "";
  return `curl '${address}' -H 'Content-Type: application/json'${key} -d '${body.replaceAll("'", "'\\''")}'`;
}
