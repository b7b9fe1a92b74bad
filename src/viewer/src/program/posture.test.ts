import { expect, test } from "vitest";
import { rods } from "../geometry/rods";
import { VERNE } from "../state/verne.fixture";
import { postureAt, postureAtRow } from "./posture";
import { emptyColumns, type RowColumns } from "./row_columns";

/** Two rows that the service planned for a line of examples/dome.cls, with a tool of 120 mm. */
const ROWS = [
  {
    tip: [-94.5, -94.5, 61.98610000000001],
    axis: [-0.4500000107699045, -0.4500000107699045, 0.7713624184611094],
    joints: [491.30163267773185, 638.1204120559509, 447.7339283218266, -47.684868402585344, 45],
  },
  {
    tip: [-90, -90, 54.2725],
    axis: [-0.45000001076990453, -0.45000001076990453, 0.7713624184611095],
    joints: [501.2720461059863, 648.9065635774323, 457.03664579658926, -47.74641529281504, 45],
  },
];

function columns(): RowColumns {
  const found = emptyColumns(ROWS.length);
  found.count = ROWS.length;
  ROWS.forEach(({ tip, axis, joints }, row) => {
    found.tip.set(tip, 3 * row);
    found.axis.set(axis, 3 * row);
    Object.values(found.joints).forEach((column, i) => (column[row] = joints[i] ?? 0));
  });
  return found;
}

/** How far the rods of a posture are from their lengths, mm. */
function error({ joints, platform }: ReturnType<typeof postureAtRow>): number {
  const { L1, L2, L3 } = VERNE.geometry;
  const all = rods(VERNE.geometry, joints.rho, platform);
  return Math.max(
    ...all.map(({ leg, slider, platform: end }) =>
      Math.abs(slider.distanceTo(end) - ([L1, L2, L3][leg] ?? 0)),
    ),
  );
}

test("at a row every rod has its length, and the tool is the one that fits", () => {
  for (const row of [0, 1]) {
    const posture = postureAtRow(columns(), row, VERNE, [90, 120, 150]);
    expect(posture.length).toBe(120);
    expect(error(posture)).toBeLessThan(1e-6);
  }
});

test("between two rows the rods keep their lengths within the tolerance of the rows", () => {
  for (const fraction of [0.25, 0.5, 0.75]) {
    const posture = postureAt(columns(), { row: 0, fraction }, VERNE, [120]);
    expect(error(posture)).toBeLessThan(0.01);
    // The tool's end follows from the platform.
    const alpha = (posture.platform.alpha * Math.PI) / 180;
    expect(posture.tool.z - posture.platform.z).toBeCloseTo(120 * Math.cos(alpha), 9);
  }
});
