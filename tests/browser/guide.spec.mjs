// The guide: pages, drawings, search and themes, under the policy that the service sends.
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { expect, test } from "./viewer.mjs";

const AXE = readFileSync(fileURLToPath(import.meta.resolve("axe-core/axe.min.js")), "utf8");
// The frame of mdBook's pages, which is not ours: its button of the chapters, and blocks that scroll.
const OF_MDBOOK = ["aria-allowed-attr", "aria-prohibited-attr", "region", "scrollable-region-focusable"];
const PAGES = ["index", "limits", "workspaces", "tool-paths", "operations", "mathematics", "start/cam"];

async function violations(page) {
  await page.evaluate(AXE);
  const { violations } = await page.evaluate(() => window.axe.run());
  return violations
    .filter(({ id }) => !OF_MDBOOK.includes(id))
    .map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html).join(" | ")}`);
}

for (const [name, viewport] of [
  ["desk", { width: 1280, height: 720 }],
  ["phone", { width: 390, height: 844 }],
]) {
  for (const colorScheme of ["light", "dark"]) {
    test.describe(`${name}, ${colorScheme}`, () => {
      test.use({ colorScheme, viewport });

      test("pages fit the screen, show their drawings and are accessible", async ({ page }) => {
        for (const chapter of PAGES) {
          await page.goto(`/guide/${chapter}.html`);
          const blank = await page.evaluate(() =>
            [...document.images].filter((image) => image.naturalWidth === 0).map(({ src }) => src),
          );
          expect(blank, `${chapter} lacks drawings`).toEqual([]);
          const excess = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
          expect(excess, `${chapter} is wider than the screen`).toBeLessThanOrEqual(0);
          expect(await violations(page), chapter).toEqual([]);
        }
      });
    });
  }
}

test("the search finds a limit and leads to it", async ({ page }) => {
  await page.goto("/guide/");
  await page.getByRole("button", { name: "Toggle Searchbar" }).click();
  await page.getByRole("searchbox").pressSequentially("rod_interference");
  await page.locator("#mdbook-searchresults a", { hasText: "rod_interference" }).first().click();
  await expect(page).toHaveURL(/limits\.html/);
});

test("the list of chapters leads from page to page", async ({ page }) => {
  await page.goto("/guide/start/curl.html");
  await page.getByRole("navigation", { name: "Table of contents" }).getByRole("link", { name: "Glossary" }).click();
  await expect(page.getByRole("heading", { level: 1, name: "Glossary" })).toBeVisible();
});
