// WCAG by axe-core, in light and dark, at the sizes that the page is made for.
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { drop, expect, open, test } from "./viewer.mjs";

const AXE = readFileSync(fileURLToPath(import.meta.resolve("axe-core/axe.min.js")), "utf8");

async function violations(page) {
  await page.evaluate(AXE);
  const { violations } = await page.evaluate(() => window.axe.run());
  return violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html).join(" | ")}`);
}

for (const colorScheme of ["light", "dark"]) {
  for (const [name, viewport] of [
    ["desk", { width: 1280, height: 720 }],
    ["tablet", { width: 1024, height: 768 }],
    ["narrow", { width: 768, height: 1024 }],
    ["phone", { width: 390, height: 844 }],
    ["landscape", { width: 844, height: 390 }],
  ]) {
    test.describe(`${colorScheme}, ${name}`, () => {
      test.use({ colorScheme, viewport, provoked: [/status of 422/] });

      test("has no accessibility violations with everything shown", async ({ page }) => {
        await open(page, "#joints=20,690,400,0,0&ghosts=assembly&workspace=tool&section=1200");
        await expect(page.getByTestId("slice-area")).toBeVisible();
        await expect(page.getByTestId("ghost-count")).toBeVisible();
        await page.getByRole("button", { name: /^Show all/ }).click();
        await page.getByText("Colours and words").click();
        const x = page.getByLabel("X on the part, mm");
        await x.fill("1e12");
        await x.press("Enter");
        await expect(page.locator(".fault")).toBeVisible();
        await page.getByRole("button", { name: "Measure" }).click();
        await page.locator("summary", { hasText: "Copy" }).click();
        expect(await violations(page)).toEqual([]);
        await page.keyboard.press("Escape");
        await page.getByRole("button", { name: "Help" }).click();
        await expect(page.getByRole("dialog")).toBeVisible();
        expect(await violations(page)).toEqual([]);
        await page.keyboard.press("Escape");
        await drop(page, "broken.json", '{"name": "x"}');
        await expect(page.getByRole("dialog")).toBeVisible();
        expect(await violations(page)).toEqual([]);
      });
    });
  }
}
