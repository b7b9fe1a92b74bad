import { expect, test } from "vitest";
import { cubicMetres, number } from "./numbers";

test("numbers as they are read", () => {
  expect(number(-1234567.84)).toBe("−1\u202f234\u202f567.8");
  expect(number(-0.01)).toBe("0.0");
  expect(number(999.96)).toBe("1\u202f000.0");
  expect(cubicMetres(300444392.2)).toBe("0.300444\u00a0m³");
});
