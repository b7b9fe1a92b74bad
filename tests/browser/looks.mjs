// The page in light and dark at the sizes that it is made for, checked by axe-core for WCAG. One page is loaded once and
// changes its look: nothing of the page depends on the look with which it was loaded.
import { mkdirSync, readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { drawn, expect, test } from "./viewer.mjs";

const AXE = readFileSync(fileURLToPath(import.meta.resolve("axe-core/axe.min.js")), "utf8");

const SIZES = {
  desk: { width: 1280, height: 720 },
  tablet: { width: 1024, height: 768 },
  narrow: { width: 768, height: 1024 },
  phone: { width: 390, height: 844 },
  landscape: { width: 844, height: 390 },
};

/** Calls `check` in every look. With PICTURES in the environment, pictures called `subject` are saved there. */
export async function inEveryLook(page, subject, check) {
  // Many looks, on a machine that may be busy.
  test.slow();
  const folder = process.env.PICTURES;
  if (folder) mkdirSync(folder, { recursive: true });
  for (const [size, viewport] of Object.entries(SIZES)) {
    await page.setViewportSize(viewport);
    for (const colorScheme of ["light", "dark"])
      await test.step(`${subject}: ${size}, ${colorScheme}`, async () => {
        await page.emulateMedia({ colorScheme });
        await drawn(page);
        await check();
        if (folder) await page.screenshot({ path: `${folder}/${subject}-${size}-${colorScheme}.png` });
      });
  }
}

/** Expects no violation in the page or in a part of it. */
export async function expectAccessible(page, part) {
  if (!(await page.evaluate(() => "axe" in window))) await page.evaluate(AXE);
  const { violations } = await page.evaluate((part) => window.axe.run(part ?? document), part);
  expect(violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html).join(" | ")}`)).toEqual([]);
}

/** Expects that the page does not scroll sideways, and that no text or control reaches out of the parts. */
export async function expectNothingOverflows(page, ...parts) {
  const excess = (element) => element.scrollWidth - element.clientWidth;
  expect(await page.locator("html").evaluate(excess)).toBe(0);
  for (const part of parts) expect(await page.locator(part).evaluate(excess), part).toBeLessThanOrEqual(0);
}

/** Where the scene lies over a text, axe would compare the text with the scene. */
export async function scrollUp(page) {
  await page.locator("main").evaluate((main) => main.scrollTo(0, 0));
}
