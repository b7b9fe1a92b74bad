/** Why the machine cannot be where it is wanted. */

import type { Answer, Limit } from "verne-client";
import { end, leg, lowest, rods } from "./elements";
import { degrees, mm, number } from "./numbers";

/** Why an answer has no solution. */
export function reasonOf(answer: Answer): string {
  if (answer.reason === "self_motion") return "The sliders do not hold the platform there.";
  const limit = answer.constraint;
  if (!limit) return "Out of reach.";
  return `Out of reach: ${broken(limit)}.`;
}

/** A broken limit in words; its value is negative. */
export function broken({ constraint, element, value }: Limit): string {
  const over = Math.abs(value);
  switch (constraint) {
    case "stroke": {
      const [slider = "", which] = element.split(".");
      return `${slider.replace(/^slider/, "slider ")} ${mm(over)} beyond its ${end(which)} end`;
    }
    case "leg_length":
      return `${leg(element)} too short by ${mm(over)}`;
    case "slider_joint":
      return `${rods(element)} bent ${degrees(over)} too far at the slider`;
    case "platform_joint":
      return `${rods(element)} bent ${degrees(over)} too far at the platform`;
    case "rod_crossing":
      return "the rods of leg 1 cross";
    case "rod_interference":
      return `${rods(element)} run into each other by ${mm(over)}`;
    case "serial_singularity":
      return `${rods(element)} too nearly across the guideway (by ${number(over, 3)})`;
    case "parallel_singularity":
      return `the platform is not held firmly enough (by ${number(over, 3)})`;
    case "tilt":
      return `the table tilted ${degrees(over)} too far`;
    case "rotary":
      return `the table turned ${degrees(over)} too far`;
    case "table_clearance":
      return `${lowest(element)} ${mm(over)} too low over the table`;
  }
}
