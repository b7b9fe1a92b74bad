import { expect, test } from "vitest";
import { DEFAULTS } from "../program/settings";
import { differing, type Snapshot } from "./step";
import { INITIAL } from "./view";

const open = (settings: object): Snapshot => ({ ...INITIAL, program: { id: "a", name: "a.cls", settings } });
const at = (x: number) => open({ setup: { ...DEFAULTS.setup, x } });

test("equal views differ in nothing, and a control that is dragged changes the same field again", () => {
  expect(differing(at(1), at(1))).toBe("");
  expect(differing({ ...INITIAL, tool: 50 }, { ...INITIAL, tool: 51 })).toBe("tool");
  expect(differing(open({}), at(1))).toBe(differing(at(1), at(2)));
});

test("a program is opened in another step than its settings are changed, however fast one follows the other", () => {
  const opened = differing(INITIAL, open({}));
  expect(opened).not.toBe("");
  expect(differing(open({}), at(1))).not.toBe(opened);
  expect(differing(open({}), INITIAL)).not.toBe(opened);
  expect(differing(at(1), open({ onLimit: "retract" }))).not.toBe(differing(at(1), at(2)));
});
