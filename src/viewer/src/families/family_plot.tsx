/** Volume over the parameter of a family. A click on the plot shows the workspace of the nearest member. */

import { effect, signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { onTheme } from "../program/colours";
import { wakeOn } from "../program/wake_on";
import { columnsOf, NAMES } from "./family_members";
import { current, family, pointedMember, showMember, type Family } from "./family_state";

const FONT = "11px system-ui, sans-serif";

export function FamilyPlot() {
  const box = useRef<HTMLDivElement>(null);
  useEffect(() => (box.current ? draw(box.current) : undefined), []);
  return (
    <div
      ref={box}
      class="family-plot"
      data-testid="family-plot"
      role="img"
      aria-label="Volume over the values; the table below has the same figures"
    />
  );
}

/** Draws a plot that follows the signals, until the function that it returns is called. */
function draw(box: HTMLElement): () => void {
  let plot: uPlot | null = null;
  const width = signal(box.clientWidth);
  const theme = signal(0);
  const sizes = new ResizeObserver(() => (width.value = box.clientWidth));
  sizes.observe(box);
  const stops = [
    effect(() => {
      wakeOn(theme);
      const found = family.value;
      if (!found) return;
      const made = new uPlot(options(found, box), columnsOf(found.members), box);
      made.over.addEventListener("click", () => {
        const place = made.cursor.idx;
        if (typeof place === "number") showMember(place);
      });
      plot = made;
      return () => {
        plot = null;
        made.destroy();
      };
    }),
    effect(() => {
      if (width.value > 0) plot?.setSize({ width: width.value, height: box.clientHeight });
    }),
    effect(() => {
      wakeOn(current);
      plot?.redraw(false);
    }),
    onTheme(() => (theme.value += 1)),
  ];
  return () => {
    stops.forEach((stop) => stop());
    sizes.disconnect();
  };
}

function options({ parameter, members }: Family, box: HTMLElement): uPlot.Options {
  const axis = {
    font: FONT,
    labelFont: FONT,
    labelSize: 14,
    stroke: tone("--quiet"),
    grid: { stroke: tone("--line"), width: 1 },
    ticks: { show: false },
    gap: 3,
  };
  return {
    width: Math.max(box.clientWidth, 10),
    height: Math.max(box.clientHeight, 10),
    padding: [8, 14, 0, 0],
    legend: { show: false },
    cursor: { y: false, drag: { x: false, y: false } },
    scales: { x: { time: false } },
    axes: [
      { ...axis, size: 20, label: `${NAMES[parameter]}, ${parameter === "phi1" ? "°" : "mm"}` },
      { ...axis, size: 46, label: "volume, m³", space: 26 },
    ],
    series: [
      {},
      {
        stroke: tone("--accent"),
        width: 1.5,
        points: { show: true, size: 6, fill: tone("--accent"), stroke: tone("--accent") },
      },
    ],
    hooks: {
      setCursor: [({ cursor }) => (pointedMember.value = cursor.idx ?? null)],
      draw: [(plot) => errorBars(plot, members), markCurrent],
    },
  };
}

/** The range of the true volume, from the error of each member. */
function errorBars(plot: uPlot, members: Family["members"]): void {
  const { ctx } = plot;
  ctx.save();
  ctx.strokeStyle = tone("--accent");
  ctx.beginPath();
  for (const { value, volume, error } of members) {
    if (volume === null) continue;
    const x = plot.valToPos(value, "x", true);
    ctx.moveTo(x, plot.valToPos((volume - error) / 1e9, "y", true));
    ctx.lineTo(x, plot.valToPos((volume + error) / 1e9, "y", true));
  }
  ctx.stroke();
  ctx.restore();
}

/** A line at the value that the page has now. */
function markCurrent(plot: uPlot): void {
  const at = current.peek();
  const { ctx, bbox } = plot;
  const x = at === null ? Number.NaN : plot.valToPos(at, "x", true);
  if (!(x >= bbox.left && x <= bbox.left + bbox.width)) return;
  ctx.save();
  ctx.strokeStyle = tone("--warn");
  ctx.lineWidth = 2;
  ctx.setLineDash([5, 4]);
  ctx.beginPath();
  ctx.moveTo(x, bbox.top);
  ctx.lineTo(x, bbox.top + bbox.height);
  ctx.stroke();
  ctx.restore();
}

function tone(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}
