/** The tool's path on the table, coloured by the worst margin; rapids are dashed. */

import { effect, untracked } from "@preact/signals";
import {
  BufferAttribute,
  BufferGeometry,
  Group,
  LineBasicMaterial,
  LineDashedMaterial,
  LineSegments,
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
import { segments } from "./path_segments";
import { framing, plan, type Plan } from "./program_state";
import { roundPoint } from "./round_point";

/** Segments that are drawn as wide lines; more of them would be slow, and are near each other anyway. */
const MOST_WIDE = 40_000;

export class PathLines {
  /** In the part frame, mm. */
  readonly group = new Group();
  /** The row to which each segment of a line leads. */
  readonly rows = new Map<Object3D, Uint32Array>();
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
    stage.scene.add(this.group);
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
      if (framing.value > 0) untracked(() => framePath(stage, this.group));
    });
    listenForClicks(stage, this);
  }

  private build(found: Plan | null): void {
    for (const drawn of this.group.children as LineSegments[]) drawn.geometry.dispose();
    this.group.clear();
    this.rows.clear();
    if (found && found.rows.count > 0) {
      const { feed, rapid, broken } = segments(found);
      this.addFeed(found, feed);
      const dashed = new LineSegments(thin(places(found, rapid)), this.rapid);
      dashed.computeLineDistances();
      this.add(dashed, rapid);
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
    this.group.add(new LineSegments2(wide, this.wideFeed), hidden);
  }

  /** What cannot be done lies over everything else, so that nothing hides it. */
  private addBroken(found: Plan, broken: Uint32Array): void {
    const at = places(found, broken.subarray(0, MOST_WIDE));
    const lines = new LineSegments2(new LineSegmentsGeometry().setPositions(at), this.broken);
    lines.renderOrder = 25;
    if (broken.length > 0) this.group.add(lines);
    const worst = found.report.failures.flatMap(({ at: { x, y, z } }) => [x, y, z]);
    const marks = new Points(thin(new Float32Array(worst)), this.mark);
    marks.renderOrder = 26;
    this.group.add(marks);
  }

  private add(lines: LineSegments, rows: Uint32Array): void {
    this.rows.set(lines, rows);
    this.group.add(lines);
  }
}

/** The ends of the segments that lead to these rows from the rows before them. */
function places({ rows }: Plan, to: Uint32Array): Float32Array {
  const found = new Float32Array(6 * to.length);
  to.forEach((row, i) => found.set(rows.tip.subarray(3 * row - 3, 3 * row + 3), 6 * i));
  return found;
}

/** The colours of these ends. */
function coloured({ rows }: Plan, to: Uint32Array): Float32Array {
  const colours = new Float32Array(6 * to.length);
  const dark = isDark();
  to.forEach((row, i) => {
    colours.set(marginColour(rows.fraction[row - 1] ?? 0, dark).map(linear), 6 * i);
    colours.set(marginColour(rows.fraction[row] ?? 0, dark).map(linear), 6 * i + 3);
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
