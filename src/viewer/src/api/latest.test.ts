import { expect, test } from "vitest";
import { latest } from "./latest";

test("what comes while one is under way waits, and only the latest is done", async () => {
  const done: number[] = [];
  const ends: (() => void)[] = [];
  const ask = latest<number>(async (value) => {
    done.push(value);
    await new Promise<void>((end) => ends.push(end));
  });
  ask(1);
  ask(2);
  ask(3);
  expect(done).toEqual([1]);
  ends.shift()?.();
  await new Promise((next) => setTimeout(next));
  expect(done).toEqual([1, 3]);
});
