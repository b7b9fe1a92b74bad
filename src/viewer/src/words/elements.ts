/** The parts of the machine, as an operator calls them. z points down: a slider's greatest z is its lower end. */

import type { Schemas } from "verne-client";

type Constraint = Schemas["Constraint"];

/** A limit as meshes name it, `stroke slider2.max`. */
export function limitInWords(name: string): string {
  const [constraint = "", element = ""] = name.split(" ");
  return boundary(constraint as Constraint, element);
}

/** `slider2.max` → "slider 2 at its lower end"; for legends. */
export function boundary(constraint: Constraint, element: string): string {
  const slider = /^slider(\d)\.(min|max)$/.exec(element);
  if (slider) return `slider ${slider[1]} at its ${end(slider[2])} end`;
  switch (constraint) {
    case "slider_joint":
      return `slider joint, ${rods(element)}`;
    case "platform_joint":
      return `platform joint, ${rods(element)}`;
    case "rod_interference":
      return `${rods(element)} touch`;
    case "rod_crossing":
      return "rods of leg 1 cross";
    case "leg_length":
      return `${leg(element)} at full stretch`;
    case "serial_singularity": {
      const named = rods(element);
      return `${named} across ${named.startsWith("rods") ? "their" : "its"} guideway`;
    }
    case "parallel_singularity":
      return "platform no longer held";
    case "tilt":
      return `table tilted to its ${element.endsWith("max") ? "greatest" : "least"} angle`;
    case "rotary":
      return `table turned to its ${element.endsWith("max") ? "greatest" : "least"} angle`;
    case "table_clearance":
      return `${lowest(element)} as near to the table as allowed`;
    case "stroke":
      return `stroke of ${element}`;
  }
}

export function end(which: string | undefined): "upper" | "lower" {
  return which === "max" ? "lower" : "upper";
}

export function leg(element: string): string {
  return element.replace(/^leg(\d)$/, "leg $1");
}

/** What is lowest over the table: `tool` or `joint12`. */
export function lowest(element: string): string {
  return element === "tool" ? "the tool’s end" : element.replace(/^joint(\d+)$/, "platform joint $1");
}

/** A parallelogram's two rods are parallel: the service names the first for both. */
export function rods(element: string): string {
  const pair = /^rods(\d+)-(\d+)$/.exec(element);
  if (pair) return `rods ${pair[1]} and ${pair[2]}`;
  const one = /^rod(\d+)$/.exec(element)?.[1];
  if (one === "21") return "rods 21, 22";
  if (one === "31") return "rods 31, 32";
  return one ? `rod ${one}` : element;
}
