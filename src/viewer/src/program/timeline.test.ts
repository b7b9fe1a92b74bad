import { expect, test } from "vitest";
import { emptyColumns, type RowColumns } from "./row_columns";
import { ASSUMED_SPEED, instantAt, jointsAt, rates, rowOfLine, times } from "./timeline";

function rows(durations: number[], lines: number[], rho1: number[]): RowColumns {
  const columns = emptyColumns(durations.length);
  columns.count = durations.length;
  columns.duration.set(durations);
  columns.line.set(lines);
  columns.joints.rho1.set(rho1);
  return columns;
}

const PLAN = rows([Number.NaN, 2, 0, 4, Number.NaN], [3, 5, 5, 6, 9], [0, 10, 10, 50, 450]);

test("time is the sum of the durations; an unknown one follows from assumed speeds", () => {
  const assumed = (450 - 50) / ASSUMED_SPEED.slider;
  expect([...times(PLAN)]).toEqual([0, 2, 2, 6, 6 + assumed]);
});

test("between two rows the joints move linearly in time", () => {
  const time = times(PLAN);
  expect(instantAt(time, 3)).toEqual({ row: 2, fraction: 0.25 });
  expect(jointsAt(PLAN, instantAt(time, 3)).rho1).toBe(20);
  for (let row = 0; row < PLAN.count; row += 1)
    expect(jointsAt(PLAN, instantAt(time, time[row] ?? 0)).rho1).toBe(PLAN.joints.rho1[row]);
});

test("times outside the program are its ends", () => {
  const time = times(PLAN);
  expect(instantAt(time, -1)).toEqual({ row: 0, fraction: 0 });
  expect(instantAt(time, 1e9)).toEqual({ row: 4, fraction: 0 });
  expect(instantAt(new Float64Array([0]), 5)).toEqual({ row: 0, fraction: 0 });
});

test("rates integrate to the way of the joint", () => {
  const time = times(PLAN);
  const rate = rates(PLAN, time, "rho1");
  const way = rate.reduce(
    (sum, value, row) => sum + value * ((time[row] ?? 0) - (time[row - 1] ?? 0) || 0),
    0,
  );
  expect(way).toBeCloseTo(450, 9);
});

test("a line is where its motion ends; a line without motion, where the one before does", () => {
  expect(rowOfLine(PLAN, 5)).toBe(2);
  expect(rowOfLine(PLAN, 8)).toBe(3);
  expect(rowOfLine(PLAN, 99)).toBe(4);
  expect(rowOfLine(PLAN, 2)).toBe(-1);
});
