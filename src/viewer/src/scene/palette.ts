/** The scene's colours, taken from the page's style so that both are light or dark together. */

import { Color } from "three";

const NAMES = [
  "background",
  "grid",
  "frame",
  "metal",
  "rod",
  "platform",
  "table",
  "accent",
  "ghost",
  "broken-ghost",
  "tool",
  "bad",
  "warn",
  "ink",
  "cut",
  "cut-line",
] as const;
export type Tone = (typeof NAMES)[number];
export type Palette = Record<Tone, Color>;

export function readPalette(): Palette {
  const style = getComputedStyle(document.documentElement);
  const entries = NAMES.map((name) => [name, new Color(style.getPropertyValue(`--scene-${name}`).trim())]);
  return Object.fromEntries(entries) as Palette;
}

/** Calls now, and whenever light becomes dark or the other way. */
export function followPalette(use: (palette: Palette) => void): void {
  use(readPalette());
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => use(readPalette()));
}
