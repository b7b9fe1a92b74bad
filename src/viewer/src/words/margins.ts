/** Every margin of a pose as a bar with a sentence, worst first. */

import type { Limit, Machine, Margins } from "verne-client";
import { broken } from "./limits";
import { degrees, mm, number } from "./numbers";
import { end, lowest, rods } from "./elements";

export interface Bar extends Limit {
  /** The margin as a part of its constraint's own range: what makes lengths and angles comparable. */
  part: number;
  sentence: string;
}

/** What some constraints are measured by: their values at home. */
export interface Home {
  det: number;
  rodDistance: number;
}

const RODS = [
  ["rod11", 0],
  ["rod12", 1],
  ["rod21", 2],
  ["rod31", 4],
] as const;

export function bars(margins: Margins, machine: Machine, home: Home): Bar[] {
  const { geometry: g, limits } = machine;
  const found: Bar[] = [];
  const add = (
    constraint: Limit["constraint"],
    unit: Limit["unit"],
    element: string,
    value: number,
    range: number,
  ) => {
    const limit: Limit = { constraint, unit, element, value };
    found.push({ ...limit, part: value / range, sentence: value < 0 ? broken(limit) : kept(limit) });
  };
  const nearest = (
    ends: number[],
    range: number[],
    name: string,
    ...what: ["stroke" | "tilt" | "rotary", "mm" | "deg"]
  ) => {
    const [low = 0, high = 0] = ends;
    const [least = 0, most = 0] = range;
    add(...what, `${name}.${high < low ? "max" : "min"}`, Math.min(low, high), most - least);
  };
  margins.stroke.forEach((ends, i) =>
    nearest(ends, limits.stroke[i] ?? [], `slider${i + 1}`, "stroke", "mm"),
  );
  margins.leg_length.forEach((value, i) =>
    add("leg_length", "mm", `leg${i + 1}`, value, [g.L1, g.L2, g.L3][i] ?? 1),
  );
  for (const [rod, i] of RODS) {
    add("serial_singularity", "1", rod, margins.serial_singularity[i] ?? 0, 1);
    add("slider_joint", "deg", rod, margins.slider_joint[i] ?? 0, limits.slider_cone);
    add("platform_joint", "deg", rod, margins.platform_joint[i] ?? 0, limits.platform_cone);
  }
  add("parallel_singularity", "1", "platform", margins.parallel_singularity, Math.abs(home.det));
  // With R1 = r1 the rods of leg I stay parallel: no limit.
  if (margins.rod_crossing !== undefined) {
    add("rod_crossing", "mm", "leg1", margins.rod_crossing, g.R1 - g.r1 || g.R1);
  }
  const { worst } = margins;
  const touching = worst.constraint === "rod_interference" ? worst.element : "rods";
  add("rod_interference", "mm", touching, margins.rod_interference, home.rodDistance);
  if (margins.tilt) nearest(margins.tilt, limits.tilt, "theta1", "tilt", "deg");
  if (margins.rotary && limits.rotary) nearest(margins.rotary, limits.rotary, "theta2", "rotary", "deg");
  if (margins.table_clearance) {
    const { constraint, unit, element, value } = margins.table_clearance;
    const longest = Math.max(...limits.stroke.map(([low = 0, high = 0]) => high - low));
    add(constraint, unit, element, value, longest);
  }
  return found.sort((a, b) => a.part - b.part);
}

/** A limit that is kept, in words. */
export function kept({ constraint, element, value }: Limit): string {
  switch (constraint) {
    case "stroke": {
      const [slider = "", which] = element.split(".");
      return `${slider.replace(/^slider/, "slider ")} is ${mm(value)} from its ${end(which)} end`;
    }
    case "leg_length":
      return `${element.replace(/^leg/, "leg ")} still drops ${mm(value)}`;
    case "slider_joint":
      return `${rods(element)} can bend ${degrees(value)} more at the slider`;
    case "platform_joint":
      return `${rods(element)} can bend ${degrees(value)} more at the platform`;
    case "rod_crossing":
      return `the rods of leg 1 are ${mm(value)} from crossing`;
    case "rod_interference":
      return `${element === "rods" ? "the nearest two rods" : rods(element)} are ${mm(value)} apart`;
    case "serial_singularity":
      return `${rods(element)}: steep enough by ${number(value, 2)} (cosine)`;
    case "parallel_singularity":
      return `the platform is held, with ${number(value, 2)} to spare (determinant)`;
    case "tilt":
      return `the table can tilt ${degrees(value)} further`;
    case "rotary":
      return `the table can turn ${degrees(value)} further`;
    case "table_clearance":
      return `${lowest(element)} can come ${mm(value)} nearer to the table`;
  }
}
