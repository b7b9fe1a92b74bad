/** The map: regions in the colours of their numbers of solutions, curves, special points, and the machine's place. */

import { useRef } from "preact/hooks";
import type { Atlas } from "verne-client";
import { number } from "../words/numbers";
import { sharesOf, type Point } from "./atlas_plane";
import { go, here, solutionsHere } from "./atlas_state";
import { colourOf, PLANES, POINTS, solutionsInWords } from "./atlas_words";

/** Parts of the window: the least region with a label, sizes of text and marks, and the distance of hatch lines. */
const LABELLED = 0.008;
const TEXT = 1 / 24;
const MARK = 1 / 110;
const DOT = 1 / 55;
const HATCH = 1 / 45;

export function AtlasMap({ atlas }: { atlas: Atlas }) {
  const svg = useRef<SVGSVGElement>(null);
  const { window, space, regions, curves, working, points } = atlas;
  const [width, height] = [size(window.u), size(window.v)];
  const down = downwards(atlas);
  const outline = (ring: Point[]) =>
    `M${ring.map(([u, v]) => `${u.toFixed(1)} ${(v * down).toFixed(1)}`).join("L")}`;
  const area = ({ outer, holes }: { outer: number[][]; holes: number[][][] }) =>
    [outer, ...holes].map((ring) => `${outline(ring as unknown as Point[])}Z`).join("");
  const counts = sharesOf(atlas).map(({ solutions }) => solutions);
  const lead = (event: MouseEvent) => {
    const matrix = svg.current?.getScreenCTM();
    if (!matrix) return;
    const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse());
    go([x, y * down]);
  };
  const text = width * TEXT;
  return (
    <svg
      ref={svg}
      class="atlas-map"
      data-testid="atlas-map"
      role="img"
      aria-label={spoken(atlas, solutionsHere.value)}
      viewBox={`${window.u[0]} ${down > 0 ? window.v[0] : -(window.v[1] ?? 0)} ${width} ${height}`}
      onClick={lead}
    >
      <defs>
        <pattern
          id="atlas-working"
          patternUnits="userSpaceOnUse"
          width={width * HATCH}
          height={width * HATCH}
          patternTransform="rotate(45)"
        >
          <path class="working-line" d={`M0 0V${width * HATCH}`} />
        </pattern>
      </defs>
      {regions.map((region, i) => (
        <path key={i} d={area(region)} fill-rule="evenodd" fill={colourOf(region.solutions, counts)} />
      ))}
      {working.regions.map((face, i) => (
        <path key={i} d={area(face)} fill-rule="evenodd" fill="url(#atlas-working)" />
      ))}
      {curves.map(({ kind, closed, points: line }, i) => (
        <path
          key={i}
          class={`curve ${kind}`}
          d={`${outline(line as unknown as Point[])}${closed ? "Z" : ""}`}
        />
      ))}
      {points.map(({ kind, at: [u = 0, v = 0] }, i) => (
        <circle key={i} class="special" cx={u} cy={v * down} r={width * MARK}>
          <title>{POINTS[kind][0]}</title>
        </circle>
      ))}
      {regions.map(({ solutions, area: whole, label: [u = 0, v = 0] }, i) =>
        whole < LABELLED * width * height ? null : (
          <text key={i} x={u} y={v * down + text * 0.35} font-size={text}>
            {solutions}
          </text>
        ),
      )}
      <Axes names={[PLANES[space].u, PLANES[space].v]} window={window} down={down} text={text} />
      <Dot radius={width * DOT} down={down} />
    </svg>
  );
}

/** The plane of the platform is seen as from above, where the base frame's y points down; that of the sliders as a plot. */
function downwards({ space }: Atlas): 1 | -1 {
  return space === "platform" ? 1 : -1;
}

interface AxesProps {
  names: [string, string];
  window: Atlas["window"];
  down: number;
  text: number;
}

/** Names at the positive ends of both axes. */
function Axes({ names, window: { u, v }, down, text }: AxesProps) {
  const [right = 0, end = 0] = [u[1], v[1]];
  const [middleU, middleV] = [clamp(0, u), clamp(0, v) * down];
  return (
    <g class="axes">
      <path class="axis" d={`M${u[0]} ${middleV}H${right}M${middleU} ${(v[0] ?? 0) * down}V${end * down}`} />
      <text x={right - text * 0.4} y={middleV - text * 0.4} font-size={text} text-anchor="end">
        {names[0]}
      </text>
      <text
        x={middleU + text * 0.4}
        y={end * down - (down > 0 ? text * 0.4 : -text)}
        font-size={text}
        text-anchor="start"
      >
        {names[1]}
      </text>
    </g>
  );
}

function Dot({ radius, down }: { radius: number; down: number }) {
  const at = here.value;
  if (!at) return null;
  return <circle class="here" data-testid="atlas-dot" cx={at[0]} cy={at[1] * down} r={radius} />;
}

function spoken(atlas: Atlas, solutions: number | null): string {
  const { u, v } = PLANES[atlas.space];
  const range = ([from = 0, to = 0]: readonly number[]) => `from ${number(from, 0)} to ${number(to, 0)} mm`;
  const where = solutions === null ? "outside of it" : `where there are ${solutionsInWords(solutions)}`;
  return `Map of solutions over ${u} ${range(atlas.window.u)} and ${v} ${range(atlas.window.v)}; the machine stands ${where}. The table below has the numbers of solutions.`;
}

function size([from = 0, to = 0]: readonly number[]): number {
  return to - from;
}

function clamp(value: number, [from = 0, to = 0]: readonly number[]): number {
  return Math.min(Math.max(value, from), to);
}
