import { expect, test } from "vitest";
import { endWords, intervalWords, noWindowWords, windowGuarantee } from "./window_words";

test("an interval and its ends are said with unit, line and limit", () => {
  expect(intervalWords({ from: -250, to: 449.9999998 }, "mm")).toBe("runs from \u2212250.0 to 450.0\u00a0mm");
  const limit = { kind: "limit", constraint: "stroke", element: "slider1.min", line: 2 } as const;
  expect(endWords(limit, "above")).toBe("above: line 2, slider 1 at its upper end");
  expect(endWords({ kind: "bound" }, "below")).toBe("below: not examined");
});

test("where nothing runs, the nearest value is named with its worst margin", () => {
  const margin = { constraint: "stroke", element: "slider1.min", margin: -3, unit: "mm", line: 5 } as const;
  const range = { from: 0, to: 90 };
  expect(noWindowWords(range, "deg", { value: 45, margin })).toBe(
    "No value from 0.0 to 90.0° was found with which the program runs. 45.0° comes nearest; there, in line 5, " +
      "slider 1 would be 3.0\u00a0mm beyond its upper end.",
  );
  expect(noWindowWords(range, "deg", undefined)).toMatch(/runs\.$/);
});

test("the guarantee names the width of what may be missed", () => {
  expect(windowGuarantee({ resolution: 0.244, unit: "mm" })).toContain(
    "narrower than 0.24\u00a0mm may be missed",
  );
});
