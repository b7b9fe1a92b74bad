import { expect, test } from "vitest";
import { longer } from "./path_segments";

test("longer segments join at the same rows and leave gaps as they are", () => {
  const { from, to } = longer(Uint32Array.from([1, 2, 3, 4, 5, 9, 10]), 2);
  expect([...from]).toEqual([0, 2, 4, 8]);
  expect([...to]).toEqual([2, 4, 5, 10]);
});
