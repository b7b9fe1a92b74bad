/** The worst margin and the joints over the time of the program. */

import { effect, signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { onTheme } from "./colours";
import { JointLegend } from "./joint_legend";
import { MarginLegend } from "./margin_legend";
import { seek } from "./player";
import { plotPoints } from "./plot_points";
import { duration, failing, now, plan, quantity, type Plan } from "./program_state";
import { JOINTS } from "./row_columns";
import { rates } from "./timeline";
import { wakeOn } from "./wake_on";

/** The times that the plots show; null: all. */
const zoom = signal<[number, number] | null>(null);

/** Pixels of a bucket. */
const BUCKET = 1.5;
const AXIS = 46;

export function Plots() {
  const zoomed = zoom.value !== null;
  return (
    <div class="plots">
      <figure>
        <figcaption>
          <span>Worst margin, % of the range of its limit</span>
          <MarginLegend />
          {zoomed && (
            <button type="button" class="small" onClick={() => (zoom.value = null)}>
              All of the time
            </button>
          )}
        </figcaption>
        <Plot kind="margin" />
      </figure>
      <figure>
        <figcaption>
          <JointLegend />
        </figcaption>
        <Plot kind="joints" />
      </figure>
    </div>
  );
}

function Plot({ kind }: { kind: "margin" | "joints" }) {
  const box = useRef<HTMLDivElement>(null);
  useEffect(() => (box.current ? draw(box.current, kind) : undefined), []);
  const name = kind === "margin" ? "Worst margin over time" : "Joints over time";
  return (
    <div ref={box} class={`plot ${kind}`} role="img" aria-label={`${name}; the time bar moves along it`} />
  );
}

/** Draws a plot that follows the signals, until the function that it returns is called. */
function draw(box: HTMLElement, kind: "margin" | "joints"): () => void {
  let plot: uPlot | null = null;
  let marker: HTMLElement | null = null;
  const width = signal(box.clientWidth);
  const theme = signal(0);
  const sizes = new ResizeObserver(() => (width.value = box.clientWidth));
  sizes.observe(box);
  const stops = [
    effect(() => {
      wakeOn(theme, quantity);
      const made = new uPlot(
        options(kind, box),
        [[], ...series(kind).map(() => [])] as uPlot.AlignedData,
        box,
      );
      marker = document.createElement("div");
      marker.className = "now";
      made.over.append(marker);
      made.over.addEventListener("click", (event) => {
        if (made.select.width > 1) return;
        seek(made.posToVal(event.offsetX, "x"));
      });
      made.over.addEventListener("dblclick", () => (zoom.value = null));
      plot = made;
      return () => made.destroy();
    }),
    effect(() => {
      // The plot is another one for each of them, and empty at first.
      wakeOn(theme, quantity);
      const found = plan.value;
      if (!plot || !found || width.value === 0) return;
      const range = zoom.value ?? [0, duration.value || 1];
      plot.setSize({ width: width.value, height: box.clientHeight });
      const buckets = Math.max(Math.floor(width.value / BUCKET), 10);
      const points = plotPoints(found.time, columns(kind, found), range, buckets);
      plot.setData([points.x, ...points.y], false);
      plot.setScale("x", { min: range[0], max: range[1] });
    }),
    effect(() => {
      wakeOn(theme, quantity, zoom, width, plan);
      if (!plot || !marker) return;
      const x = plot.valToPos(now.value, "x");
      marker.style.transform = `translateX(${x}px)`;
    }),
    onTheme(() => (theme.value += 1)),
  ];
  return () => {
    stops.forEach((stop) => stop());
    sizes.disconnect();
  };
}

function columns(kind: "margin" | "joints", { rows, time }: Plan): Float64Array[] {
  if (kind === "margin") return [rows.fraction.map((fraction) => fraction * 100)];
  return JOINTS.map((joint) =>
    quantity.value === "rate" ? rates(rows, time, joint) : rows.joints[joint].subarray(0, rows.count),
  );
}

const stepped = uPlot.paths.stepped?.({ align: -1 });

function series(kind: "margin" | "joints"): uPlot.Series[] {
  if (kind === "margin") return [{ stroke: tone("--ink"), width: 1.5, scale: "y", points: { show: false } }];
  return JOINTS.map((joint, i) => ({
    stroke: tone(`--joint-${i + 1}`),
    width: 1.5,
    scale: joint.startsWith("rho") ? "y" : "angle",
    points: { show: false },
    // A rate holds on the way to its row.
    ...(quantity.value === "rate" && stepped && { paths: stepped }),
    ...(joint.startsWith("theta") && { dash: [6, 3] }),
  }));
}

function options(kind: "margin" | "joints", box: HTMLElement): uPlot.Options {
  const rate = quantity.value === "rate";
  const axis = (scale: string, label: string, side: 1 | 3): uPlot.Axis => ({
    scale,
    // eslint-disable-next-line @typescript-eslint/no-unsafe-enum-assignment -- the enum has no values at run time
    side,
    size: AXIS,
    label,
    labelSize: 14,
    labelFont: "11px system-ui, sans-serif",
    font: "11px system-ui, sans-serif",
    stroke: tone("--quiet"),
    grid: { stroke: tone("--line"), width: 1, show: side !== 1 },
    ticks: { show: false },
    gap: 3,
    space: 22,
  });
  const time: uPlot.Axis = {
    font: "11px system-ui, sans-serif",
    stroke: tone("--quiet"),
    grid: { stroke: tone("--line"), width: 1 },
    ticks: { show: false },
    size: 18,
    gap: 2,
    values: (_, ticks) => ticks.map((tick) => `${tick} s`),
  };
  const axes =
    kind === "margin"
      ? [{ ...time, show: false }, axis("y", "%", 3)]
      : [time, axis("y", rate ? "mm/s" : "mm", 3), axis("angle", rate ? "°/s" : "°", 1)];
  return {
    width: Math.max(box.clientWidth, 10),
    height: Math.max(box.clientHeight, 10),
    padding: [6, kind === "margin" ? AXIS + 14 : 0, kind === "margin" ? 4 : 0, 0],
    legend: { show: false },
    cursor: { sync: { key: "program" }, drag: { x: true, y: false, setScale: false } },
    scales: {
      x: { time: false },
      y: kind === "margin" ? { range: (_, min, max) => [Math.min(min, 0), Math.max(max, 1)] } : {},
      angle: {},
    },
    axes,
    series: [{}, ...series(kind)],
    hooks: { setSelect: [select], drawClear: [bands] },
  };
}

/** The times that were dragged over fill the plots. */
function select(plot: uPlot): void {
  const { left, width } = plot.select;
  if (width < 5) return;
  zoom.value = [plot.posToVal(left, "x"), plot.posToVal(left + width, "x")];
  plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
}

/** Failing stretches behind the lines. */
function bands(plot: uPlot): void {
  const { ctx, bbox } = plot;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  ctx.fillStyle = tone("--failing");
  for (const [from, to] of failing.peek()) {
    const left = plot.valToPos(from, "x", true);
    ctx.fillRect(left, bbox.top, Math.max(plot.valToPos(to, "x", true) - left, 2), bbox.height);
  }
  ctx.restore();
}

export function tone(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}
