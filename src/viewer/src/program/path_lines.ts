/** The tool's path on the table, coloured by the worst margin; rapids are dashed. */

import { effect, untracked } from "@preact/signals";
import {
  BufferAttribute,
  BufferGeometry,
  Group,
  LineBasicMaterial,
  LineDashedMaterial,
  LineSegments,
  Mesh,
  Points,
  PointsMaterial,
  type Object3D,
} from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import { baseFromTable, SCENE_FROM_BASE } from "../geometry/frames";
import { followPalette } from "../scene/palette";
import type { Stage } from "../scene/stage";
import { machine, position } from "../state/store";
import { isDark, marginColour, onTheme } from "./colours";
import { framePath } from "./path_framing";
import { listenForClicks } from "./path_picking";
import { gaps, longer, segments } from "./path_segments";
import { framing, now, plan, playing, type Plan } from "./program_state";
import { roundPoint } from "./round_point";
import { wakeOn } from "./wake_on";

/** Segments that are drawn as wide lines; more of them would be slow, and are near each other anyway. */
const MOST_WIDE = 40_000;
/** Segments that a slow machine can move. */
const MOST_QUICK = 6_000;

export class PathLines {
  /** In the part frame, mm. */
  readonly group = new Group();
  /** The row to which each segment of a line leads. */
  readonly rows = new Map<Object3D, Uint32Array>();
  /** Two of them: as it is, and with longer segments for slow machines while the picture moves. */
  private readonly fine = new Group();
  private readonly quick = new Group();
  private readonly feed = new LineBasicMaterial({ vertexColors: true });
  private readonly wideFeed = new LineMaterial({ vertexColors: true, linewidth: 2 });
  /** For what lies behind the machine or inside the table. */
  private readonly hiddenFeed = new LineMaterial({
    vertexColors: true,
    linewidth: 1.5,
    depthTest: false,
    transparent: true,
    opacity: 0.3,
  });
  private readonly broken = new LineMaterial({ linewidth: 3.5, depthTest: false, transparent: true });
  private readonly rapid = new LineDashedMaterial({ dashSize: 7, gapSize: 5 });
  private readonly mark = new PointsMaterial({
    size: 11,
    sizeAttenuation: false,
    depthTest: false,
    transparent: true,
    map: roundPoint(),
  });

  constructor(private readonly stage: Stage) {
    this.group.matrixAutoUpdate = false;
    this.group.add(this.fine, this.quick);
    stage.scene.add(this.group);
    stage.beforeDrawing.push(() => {
      const { slow, moving } = stage.resolution;
      this.quick.visible = slow && moving && this.quick.children.length > 0;
      this.fine.visible = !this.quick.visible;
    });
    followPalette((palette) => {
      this.rapid.color = palette.ink;
      this.broken.color = palette.bad;
      this.mark.color = palette.bad;
      stage.draw();
    });
    effect(() => this.build(plan.value));
    onTheme(() => this.build(plan.peek()));
    effect(() => {
      const at = position.value;
      const table = machine.value?.definition.table;
      if (!at || !table) return;
      this.group.matrix.copy(SCENE_FROM_BASE).multiply(baseFromTable(table, at.joints));
      this.group.matrixWorldNeedsUpdate = true;
      stage.draw();
    });
    effect(() => {
      wakeOn(now);
      if (playing.value) stage.resolution.touch();
    });
    effect(() => {
      if (framing.value > 0) untracked(() => framePath(stage, this.group));
    });
    listenForClicks(stage, this);
  }

  private build(found: Plan | null): void {
    for (const level of [this.fine, this.quick]) {
      level.traverse((drawn) => {
        if (drawn instanceof Mesh || drawn instanceof LineSegments || drawn instanceof Points)
          (drawn.geometry as BufferGeometry).dispose();
      });
      level.clear();
    }
    this.rows.clear();
    if (found && found.rows.count > 0) {
      const { feed, rapid, broken } = segments(found);
      this.addFeed(found, feed);
      const dashed = new LineSegments(thin(places(found, rapid)), this.rapid);
      dashed.computeLineDistances();
      this.add(dashed, rapid);
      this.addQuick(found, [feed, this.feed], [rapid, this.rapid]);
      this.addBroken(found, broken);
    }
    this.stage.draw();
  }

  private addFeed(found: Plan, feed: Uint32Array): void {
    const [at, colours] = [places(found, feed), coloured(found, feed)];
    const lines = new LineSegments(thin(at, colours), this.feed);
    this.add(lines, feed);
    if (feed.length > MOST_WIDE) return;
    // Clicks are still tested against the thin ones.
    lines.visible = false;
    const wide = new LineSegmentsGeometry().setPositions(at).setColors(colours);
    const hidden = new LineSegments2(wide, this.hiddenFeed);
    hidden.renderOrder = 24;
    this.fine.add(new LineSegments2(wide, this.wideFeed), hidden);
  }

  private addQuick(found: Plan, ...kinds: [Uint32Array, LineBasicMaterial][]): void {
    const each = Math.ceil(kinds.reduce((sum, [to]) => sum + to.length, 0) / MOST_QUICK);
    if (each < 2) return;
    for (const [all, material] of kinds) {
      const { from, to } = longer(all, each);
      const lines = new LineSegments(thin(places(found, to, from), coloured(found, to, from)), material);
      lines.computeLineDistances();
      this.quick.add(lines);
    }
  }

  /** What cannot be done lies over everything else, so that nothing hides it. */
  private addBroken(found: Plan, broken: Uint32Array): void {
    const at = [...places(found, broken.subarray(0, MOST_WIDE)), ...ways(found)];
    const lines = new LineSegments2(new LineSegmentsGeometry().setPositions(at), this.broken);
    lines.renderOrder = 25;
    if (at.length > 0) this.fine.add(lines);
    const worst = found.report.failures.flatMap(({ at: { x, y, z } }) => [x, y, z]);
    const marks = new Points(thin(new Float32Array(worst)), this.mark);
    marks.renderOrder = 26;
    this.fine.add(marks);
  }

  private add(lines: LineSegments, rows: Uint32Array): void {
    this.rows.set(lines, rows);
    this.fine.add(lines);
  }
}

/** The ends of the segments that lead to these rows, from the rows before them if no others are given. */
function places(
  { rows: { tip } }: Plan,
  to: Uint32Array,
  from: Uint32Array = to.map((row) => row - 1),
): Float32Array {
  const found = new Float32Array(6 * to.length);
  to.forEach((row, i) => {
    const start = 3 * (from[i] ?? 0);
    found.set(tip.subarray(start, start + 3), 6 * i);
    found.set(tip.subarray(3 * row, 3 * row + 3), 6 * i + 3);
  });
  return found;
}

/** The ways to places that the machine cannot reach, and from there to the next rows. */
function ways(found: Plan): number[] {
  const { tip, count } = found.rows;
  const place = (row: number) => (row >= 0 && row < count ? [...tip.subarray(3 * row, 3 * row + 3)] : null);
  return gaps(found).flatMap(({ before, after, at }) =>
    [place(before), place(after)].flatMap((end) => (end ? [...end, ...at] : [])),
  );
}

/** The colours of these ends. */
function coloured(
  { rows: { fraction } }: Plan,
  to: Uint32Array,
  from: Uint32Array = to.map((row) => row - 1),
): Float32Array {
  const colours = new Float32Array(6 * to.length);
  const dark = isDark();
  to.forEach((row, i) => {
    colours.set(marginColour(fraction[from[i] ?? 0] ?? 0, dark).map(linear), 6 * i);
    colours.set(marginColour(fraction[row] ?? 0, dark).map(linear), 6 * i + 3);
  });
  return colours;
}

function thin(at: Float32Array, colours?: Float32Array): BufferGeometry {
  const made = new BufferGeometry().setAttribute("position", new BufferAttribute(at, 3));
  if (colours) made.setAttribute("color", new BufferAttribute(colours, 3));
  return made;
}

/** The renderer computes with linear colours; a part of sRGB, 0 to 255. */
function linear(srgb: number): number {
  const part = srgb / 255;
  return part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4;
}
