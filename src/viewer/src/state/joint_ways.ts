/** How far each joint alone can move from where the machine stands, and which limit ends its way. */

import { effect, signal } from "@preact/signals";
import { unwrap } from "verne-client";
import { verne } from "../api/client";
import { boundary } from "../words/elements";
import { machine, overTable, position, tool } from "./store";
import { toList, travels } from "./joints";
import { waysOf, type Examine, type Way } from "./ways";

/** For rho1, rho2, rho3, theta1, theta2; null where the machine's own posture breaks a limit. */
export const jointWays = signal<Way[] | null>(null);

/** The machine has rested so long before its ways are asked for, ms. */
const REST = 250;
export function keepJointWays(): void {
  effect(() => {
    const at = position.value;
    const known = machine.value;
    const asked = { tool_length: tool.value, ...overTable.value };
    jointWays.value = null;
    if (!at?.solution.working || !at.solution.feasible || !known) return;
    const examine: Examine = async (joints) => {
      const body = { machine: known.ref, ...asked, joints };
      const { status, constraint, element } = unwrap(await verne.api.POST("/fk/batch", { body }));
      return status.map((word, i) => {
        const limit = constraint[i];
        if (word === "ok") return null;
        return limit ? boundary(limit, element[i] ?? "") : "out of reach";
      });
    };
    const timer = setTimeout(() => {
      waysOf(toList(at.joints), travels(known.definition.limits), examine)
        .then((found) => {
          if (position.peek() === at && machine.peek() === known) jointWays.value = found;
        })
        // The sliders work without them.
        .catch(() => undefined);
    }, REST);
    return () => clearTimeout(timer);
  });
}
