import { expect, test } from "vitest";
import { bucketSize, emptyColumns, KEPT_OF_BUCKET, RowCollector, type Piece } from "./row_columns";

/** Rows whose joints and margins vary; every row takes a second. */
function rows(first: number, count: number, fraction: (row: number) => number): Piece {
  const piece = emptyColumns(count);
  piece.count = count;
  for (let i = 0; i < count; i += 1) {
    const row = first + i;
    piece.number[i] = row;
    piece.line[i] = row + 1;
    piece.kind.push("feed");
    piece.limit.push({ constraint: "stroke", element: "slider2.max" });
    piece.joints.rho1[i] = Math.sin(row / 7);
    piece.joints.theta2[i] = -row;
    piece.duration[i] = row === 0 ? Number.NaN : 1;
    piece.fraction[i] = fraction(row);
    piece.margin[i] = 750 * fraction(row);
  }
  return piece;
}

test("few rows are all kept, unchanged", () => {
  const collector = new RowCollector(10, bucketSize(10, 100));
  collector.add(rows(0, 6, (row) => row));
  collector.add(rows(6, 4, (row) => row));
  const { columns } = collector;
  expect(columns.count).toBe(10);
  expect([...columns.number]).toEqual([0, 1, 2, 3, 4, 5, 6, 7, 8, 9]);
  expect([...columns.duration.subarray(1)]).toEqual(Array(9).fill(1));
  expect(columns.duration[0]).toBeNaN();
});

test("of many rows, the worst of each bucket stays, and so does the whole time", () => {
  const [count, most] = [50_000, 2000];
  const worst = new Set([17, 20_013, 49_998]);
  const fraction = (row: number) => (worst.has(row) ? -0.1 : 0.2 + 0.1 * Math.cos(row));
  const bucket = bucketSize(count, most);
  const collector = new RowCollector(count, bucket);
  const step = 10 * bucket;
  for (let from = 0; from < count; from += step)
    collector.add(rows(from, Math.min(step, count - from), fraction));
  const { columns } = collector;
  expect(columns.count).toBeLessThanOrEqual(Math.ceil(count / bucket) * KEPT_OF_BUCKET);
  const kept = [...columns.number.subarray(0, columns.count)];
  for (const row of worst) expect(kept).toContain(row);
  expect(kept).toEqual([...new Set(kept)].sort((a, b) => a - b));
  expect([kept[0], kept.at(-1)]).toEqual([0, count - 1]);
  const durations = columns.duration.subarray(0, columns.count);
  const time = durations.reduce((sum, value) => sum + (Number.isNaN(value) ? 0 : value), 0);
  expect(time).toBe(count - 1);
  // Each row arrives after the rows between it and the one before.
  kept.forEach((row, i) => i > 0 && expect(durations[i]).toBe(row - (kept[i - 1] ?? 0)));
});
