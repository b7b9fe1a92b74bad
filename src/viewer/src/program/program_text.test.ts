import { expect, test } from "vitest";
import { ProgramText, workOffsets } from "./program_text";

const text = (content: string) => new ProgramText(new TextEncoder().encode(content));
const lines = (content: string) => {
  const read = text(content);
  return Array.from({ length: read.count }, (_, i) => read.line(i + 1));
};

test("lines have the numbers that the service counts", () => {
  expect(lines("A\nB\r\n\nC")).toEqual(["A", "B", "", "C"]);
  expect(lines("A\nB\n")).toEqual(["A", "B"]);
  expect(lines("")).toEqual([]);
  expect(lines("\n")).toEqual([""]);
  expect(text("A").line(2)).toBe("");
});

test("a long line is cut", () => {
  expect(text("x".repeat(10_000)).line(1).length).toBeLessThan(500);
});

test("the work offsets beside G54 are found", () => {
  expect(workOffsets(text("G54 X1\nN10G59.1X0\nG0G55\nG550 X5\nG5\n"))).toEqual(["G55", "G59.1"]);
});
