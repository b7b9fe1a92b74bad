/** Colours of margins: red where a limit is broken, from orange at the limit to blue far from it. */

/** The fraction of a limit's range from which a margin has the last colour; as in the GLB of the service. */
export const GREATEST = 0.25;

type Rgb = readonly [number, number, number];

interface Scale {
  broken: Rgb;
  steps: readonly Rgb[];
}

/** Both scales keep their order for colour-blind users: the lightness changes in one direction. */
const LIGHT: Scale = {
  broken: [200, 20, 30],
  steps: [
    [232, 140, 0],
    [196, 150, 60],
    [110, 140, 130],
    [40, 110, 160],
    [10, 60, 130],
  ],
};

const DARK: Scale = {
  broken: [255, 82, 76],
  steps: [
    [255, 176, 40],
    [230, 190, 110],
    [170, 200, 190],
    [120, 190, 235],
    [90, 160, 250],
  ],
};

/** The colour of a margin, as a fraction of its limit's range; sRGB, 0 to 255. */
export function marginColour(fraction: number, dark: boolean): Rgb {
  const { broken, steps } = dark ? DARK : LIGHT;
  if (fraction < 0) return broken;
  const at = Math.min(fraction / GREATEST, 1) * (steps.length - 1);
  const from = steps[Math.floor(at)] ?? broken;
  const to = steps[Math.min(Math.floor(at) + 1, steps.length - 1)] ?? from;
  const part = at - Math.floor(at);
  const mix = (i: 0 | 1 | 2) => Math.round(from[i] + part * (to[i] - from[i]));
  return [mix(0), mix(1), mix(2)];
}

const DARK_QUERY = "(prefers-color-scheme: dark)";

export function isDark(): boolean {
  return matchMedia(DARK_QUERY).matches;
}

/** Calls when light becomes dark or the other way. */
export function onTheme(call: () => void): () => void {
  const query = matchMedia(DARK_QUERY);
  query.addEventListener("change", call);
  return () => query.removeEventListener("change", call);
}
