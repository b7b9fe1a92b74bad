// What the page weighs.
import { bundle } from "./bundle.mjs";
import { expect, test } from "./viewer.mjs";

test("all scripts and styles together are less than a megabyte, and panels are loaded when they are opened", async ({
  baseURL,
}) => {
  const files = await bundle(baseURL);
  const bytes = files.reduce((sum, { body }) => sum + body.length, 0);
  expect(bytes).toBeLessThan(1_000_000);
  const first = files.filter(({ first }) => first).map(({ name }) => name);
  const later = files.filter(({ first }) => !first).map(({ name }) => name);
  for (const panel of ["program", "family_panel", "dexterity_panel", "errors_panel", "atlas_panel"]) {
    expect(later.some((name) => name.startsWith(`${panel}-`))).toBe(true);
    expect(first.some((name) => name.startsWith(`${panel}-`))).toBe(false);
  }
});
