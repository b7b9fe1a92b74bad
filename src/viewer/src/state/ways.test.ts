import { expect, test } from "vitest";
import { waysOf } from "./ways";

const TRAVEL: [number, number][] = [
  [0, 750],
  [-90, 90],
];

test("a joint's way ends at its travel, or where a limit is broken", async () => {
  let asked = 0;
  const [slider, table] = await waysOf([300, 0], TRAVEL, (rows) => {
    asked += rows.length;
    return Promise.resolve(rows.map(([rho = 0]) => (rho > 512.25 ? "leg 1" : null)));
  });
  expect(slider?.low).toEqual({ at: 0, limit: null });
  expect(slider?.high.limit).toBe("leg 1");
  expect(slider?.high.at).toBeLessThanOrEqual(512.25);
  expect(slider?.high.at).toBeGreaterThan(512.25 - 0.01);
  expect(table).toEqual({ low: { at: -90, limit: null }, high: { at: 90, limit: null } });
  expect(asked).toBeLessThan(400);
});

test("a joint at the end of its travel has no way beyond", async () => {
  const [slider] = await waysOf([750], [[0, 750]], (rows) => Promise.resolve(rows.map(() => null)));
  expect(slider?.high).toEqual({ at: 750, limit: null });
});
