import type { FamilySummary } from "verne-client";
import { expect, test } from "vitest";
import { columnsOf, membersOf, valueInWords, volumeInWords } from "./family_members";

const request = { kind: "part", phi2: 0, tolerance: 1 } as const;
const figures = { area: 1, vertices: 3, triangles: 1, folded: false, bounds: null };
const summary = {
  members: [
    {
      id: "a",
      request: { ...request, tool_length: 50, phi1: -10 },
      ...figures,
      volume: 300444391.7,
      volume_error: 53,
    },
    { id: "b", request: { ...request, tool_length: 50, phi1: 0 }, ...figures, folded: true, volume: null },
    { id: "c", request: { ...request, tool_length: 50, phi1: 10 }, failure: "the job was cancelled" },
  ],
} as unknown as FamilySummary;

test("members have their value, their volume with its error, or the reason why there is none", () => {
  const members = membersOf(summary, "phi1");
  expect(members.map(({ value }) => value)).toEqual([-10, 0, 10]);
  expect(members.map(({ reason }) => reason)).toEqual([
    null,
    "no volume: two platform positions reach the same position",
    "the job was cancelled",
  ]);
  expect(columnsOf(members)).toEqual([
    [-10, 0, 10],
    [300444391.7 / 1e9, null, null],
  ]);
});

test("the printed interval contains every volume that the error allows", () => {
  const [member] = membersOf(summary, "phi1");
  expect(member && volumeInWords(member)).toBe("0.300444 m³ ± 0.6 cm³");
  for (const volume of [300444391.7, 300444499.9, 300444500.1, 123456789])
    for (const error of [0, 53, 999, 264533]) {
      const words = volumeInWords({ value: 0, volume, error, reason: null });
      const [shown = 0, bound = 0] =
        words
          .replaceAll("\u202f", "")
          .match(/[\d.]+/g)
          ?.map(Number) ?? [];
      expect(Math.abs(shown * 1e9 - volume) + error).toBeLessThanOrEqual(bound * 1e3 + 1e-6);
    }
});

test("a value has the unit of its parameter", () => {
  expect(valueInWords("tool_length", 50)).toBe("50.0\u00a0mm");
  expect(valueInWords("phi1", -10)).toBe("\u221210.0°");
});
