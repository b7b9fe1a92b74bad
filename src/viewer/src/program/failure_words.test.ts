import { expect, test } from "vitest";
import type { Schemas } from "verne-client";
import { changeWords, clock, failureSentence } from "./failure_words";

const FAILURE: Schemas["ToolpathFailure"] = {
  lines: [1204, 1204],
  constraint: "stroke",
  element: "slider2.max",
  margin: -12.34,
  unit: "mm",
  at: { line: 1204, x: 0, y: 0, z: 0, phi1: 0, phi2: 0, tool_length: 100 },
};

test("a failure says where, which part, and by how much", () => {
  expect(failureSentence(FAILURE)).toBe(
    "line 1\u202f204: slider 2 would be 12.3\u00a0mm beyond its lower end",
  );
  expect(
    failureSentence({ ...FAILURE, lines: [7, 9], constraint: "rotary", element: "theta2.min", margin: -540 }),
  ).toBe("lines 7 to 9: the table would turn 540.0° too far");
});

test("a change that heals says what to move, which way", () => {
  expect(changeWords({ parameter: "setup.x", delta: -278.23 })).toBe(
    "move the set-up by −278.2\u00a0mm in X",
  );
  expect(changeWords({ parameter: "setup.z", delta: 28.2 })).toBe("move the set-up by +28.2\u00a0mm in Z");
  expect(changeWords({ parameter: "tool_length", delta: -5 })).toBe("make the tool 5.0\u00a0mm shorter");
});

test("times as clocks", () => {
  expect(clock(0)).toBe("0:00.0");
  expect(clock(384.47)).toBe("6:24.4");
  expect(clock(7325)).toBe("2:02:05");
});
