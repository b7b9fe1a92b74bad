/** The posture of the machine at a row: from the tool in the part frame to the platform in the base frame. */

import { MathUtils, Vector3 } from "three";
import type { Machine, PlatformPose } from "verne-client";
import { baseFromTable } from "../geometry/frames";
import { rods } from "../geometry/rods";
import type { Joints } from "../state/view";
import type { RowColumns } from "./row_columns";
import { jointsAt, type Instant } from "./timeline";

export interface Posture {
  joints: Joints;
  platform: PlatformPose;
  /** The tool's end in the base frame, mm. */
  tool: { x: number; y: number; z: number };
  /** Distance from P to the tool's end, mm. */
  length: number;
}

export function postureAtRow(rows: RowColumns, row: number, machine: Machine, lengths: number[]): Posture {
  const { rho1, rho2, rho3, theta1, theta2 } = jointsAt(rows, { row, fraction: 0 });
  const joints: Joints = { rho: [rho1, rho2, rho3], theta1, theta2 };
  const base = baseFromTable(machine.table, joints);
  const tip = new Vector3().fromArray(rows.tip, 3 * row).applyMatrix4(base);
  const axis = new Vector3().fromArray(rows.axis, 3 * row).transformDirection(base);
  const alpha = MathUtils.radToDeg(Math.atan2(axis.y, -axis.z));
  const at = (length: number): PlatformPose => {
    const { x, y, z } = tip.clone().addScaledVector(axis, length);
    return { x, y, z, alpha };
  };
  const length = closingLength(machine, joints, lengths, at);
  return { joints, platform: at(length), tool: { x: tip.x, y: tip.y, z: tip.z }, length };
}

/** Between two rows the joints are linear, and so, within the tolerance of the rows, is the platform. */
export function postureAt(
  rows: RowColumns,
  { row, fraction }: Instant,
  machine: Machine,
  lengths: number[],
): Posture {
  const from = postureAtRow(rows, row, machine, lengths);
  if (fraction === 0 || row + 1 >= rows.count) return from;
  const to = postureAtRow(rows, row + 1, machine, lengths);
  const { rho1, rho2, rho3, theta1, theta2 } = jointsAt(rows, { row, fraction });
  const joints: Joints = { rho: [rho1, rho2, rho3], theta1, theta2 };
  const between = (a: number, b: number) => a + fraction * (b - a);
  const [p, q] = [from.platform, to.platform];
  const platform: PlatformPose = {
    x: between(p.x, q.x),
    y: between(p.y, q.y),
    z: between(p.z, q.z),
    alpha: between(p.alpha, q.alpha),
  };
  const alpha = MathUtils.degToRad(platform.alpha);
  const { length } = to;
  const tool = {
    x: platform.x,
    y: platform.y - length * Math.sin(alpha),
    z: platform.z + length * Math.cos(alpha),
  };
  return { joints, platform, tool, length };
}

/** The tool length with which the first rod has its length: rows do not say which tool they have. */
function closingLength(
  machine: Machine,
  joints: Joints,
  lengths: number[],
  at: (length: number) => PlatformPose,
): number {
  const [first = 0] = lengths;
  if (lengths.length < 2) return first;
  const error = (length: number) => {
    const [rod] = rods(machine.geometry, joints.rho, at(length));
    return rod ? Math.abs(rod.slider.distanceTo(rod.platform) - machine.geometry.L1) : 0;
  };
  return lengths.reduce((best, length) => (error(length) < error(best) ? length : best), first);
}
