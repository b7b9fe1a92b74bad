/** The bounds within which a set-up is searched for, and the distances that it is to keep. */

import type { Schemas } from "verne-client";
import type { Settings } from "./settings";

export type FreeName = keyof Schemas["FreeParameters"];
export type ReserveName = keyof Schemas["Reserve"];

/** The bounds of a parameter, and whether it may change. */
export interface Freedom {
  free: boolean;
  from: number;
  to: number;
}

/** How far from the present set-up the search goes at first, mm and degrees. */
const WAYS: Record<FreeName, number> = {
  "setup.x": 200,
  "setup.y": 200,
  "setup.z": 200,
  "setup.c": 90,
  tool_length: 50,
};
export const FREE_NAMES = Object.keys(WAYS) as FreeName[];
/** The limits for which a reserve can be asked; the others must hold. */
export const RESERVES = ["stroke", "slider_joint", "platform_joint", "rod_interference"] as const;

/** The bounds that are offered: around the present set-up. x, y and z may change at first. */
export function usualFreedoms({ setup, lengths }: Settings): Record<FreeName, Freedom> {
  const value = (name: FreeName) =>
    name === "tool_length"
      ? typeof lengths === "number"
        ? lengths
        : 100
      : setup[name.slice(-1) as "x" | "y" | "z" | "c"];
  const around = (name: FreeName): Freedom => {
    const [middle, way] = [value(name), WAYS[name]];
    const least = name === "tool_length" ? 0 : -Infinity;
    const free = name === "setup.x" || name === "setup.y" || name === "setup.z";
    return { free, from: Math.max(middle - way, least), to: middle + way };
  };
  return Object.fromEntries(FREE_NAMES.map((name) => [name, around(name)])) as Record<FreeName, Freedom>;
}

/** The fields of a request; the tool's length is free only where one length holds for every tool. */
export function freeOf(all: Record<FreeName, Freedom>, oneLength: boolean): Schemas["FreeParameters"] {
  const chosen = FREE_NAMES.filter((name) => all[name].free && (name !== "tool_length" || oneLength));
  return Object.fromEntries(chosen.map((name) => [name, [all[name].from, all[name].to]]));
}

/** The reserves that are asked for. */
export function reserveOf(all: Record<string, number>): Schemas["Reserve"] {
  return Object.fromEntries(Object.entries(all).filter(([, value]) => value > 0));
}
