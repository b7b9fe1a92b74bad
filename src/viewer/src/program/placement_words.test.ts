import { expect, test } from "vitest";
import { activeWords, guaranteeWords, reserveWords } from "./placement_words";

test("the reserve that is kept is said as a part or a multiple", () => {
  expect(reserveWords(13.43)).toBe("13.43 times the reserve");
  expect(reserveWords(0.456)).toBe("46 % of the reserve");
  expect(reserveWords(0)).toBe("0 % of the reserve");
  expect(reserveWords(-0.5)).toBe("misses a limit by 0.50 of its reserve");
  expect(reserveWords(null)).toBe("out of reach");
});

test("a margin that limits has its line, the distance and the reserve", () => {
  const margin = {
    line: 3,
    constraint: "stroke",
    element: "slider3.min",
    margin: 18.25,
    unit: "mm",
  } as const;
  expect(activeWords({ ...margin, reserve: 20 })).toBe(
    "line 3: slider 3 is 18.3\u00a0mm from its upper end (reserve 20.0\u00a0mm)",
  );
  expect(activeWords({ ...margin, margin: -4 })).toBe(
    "line 3: slider 3 would be 4.0\u00a0mm beyond its upper end",
  );
});

test("the guarantee says what was checked and what is not proved", () => {
  const words = guaranteeWords({ kind: "best_of_starts", starts: 34 }, 74, true);
  expect(words).toContain("All 74 joint rows");
  expect(words).toContain("best of 34 searches; it is not proved");
  expect(words).toContain("never worse");
  expect(guaranteeWords({ kind: "best_of_starts", starts: 1 }, 74, false)).not.toContain("never worse");
});
