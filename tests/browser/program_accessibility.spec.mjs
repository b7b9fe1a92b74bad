// Programs by WCAG, in light and dark, at the sizes that the page is made for.
import { readFileSync } from "node:fs";
import { resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { drop, expect, open, test } from "./viewer.mjs";

const AXE = readFileSync(fileURLToPath(import.meta.resolve("axe-core/axe.min.js")), "utf8");
const DOME = readFileSync(resolve(import.meta.dirname, "../../examples/dome.cls"), "utf8");

async function violations(page) {
  await page.evaluate(AXE);
  const { violations } = await page.evaluate(() => window.axe.run());
  return violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html).join(" | ")}`);
}

for (const colorScheme of ["light", "dark"]) {
  for (const [name, viewport] of [
    ["desk", { width: 1280, height: 720 }],
    ["tablet", { width: 1024, height: 768 }],
    ["phone", { width: 390, height: 844 }],
    ["landscape phone", { width: 844, height: 390 }],
  ]) {
    test.describe(`${colorScheme}, ${name}`, () => {
      test.use({ colorScheme, viewport, provoked: [/status of 422/] });

      test("a program that fails has no accessibility violations, and nothing overflows", async ({ page }) => {
        await open(page, "#workspace=hidden");
        await drop(page, "dome.cls", DOME);
        await expect(page.getByText("12 stretches fail")).toBeVisible();
        await page.getByText("Tolerances and motion").click();
        await page.getByText("One warning").click();
        await page.getByRole("button", { name: "Show all 12" }).click();
        // Where the scene lies over the text, axe would compare the text with the scene.
        await page.locator("main").evaluate((main) => main.scrollTo(0, 0));
        expect(await violations(page)).toEqual([]);
        const overflow = () => document.documentElement.scrollWidth - document.documentElement.clientWidth;
        expect(await page.evaluate(overflow)).toBe(0);
        for (const part of [".dock", ".program"]) {
          const wider = (element) => element.scrollWidth - element.clientWidth;
          expect(await page.locator(part).evaluate(wider), part).toBeLessThanOrEqual(0);
        }
        // The scene covers nothing of the motion.
        await page.locator("main").evaluate((main) => main.scrollTo(0, 0));
        const [scene, dock] = [await page.locator(".scene").boundingBox(), await page.locator(".dock").boundingBox()];
        const beside = scene.x + scene.width <= dock.x + 1 || scene.y + scene.height <= dock.y + 1;
        expect(beside, JSON.stringify([scene, dock])).toBe(true);
        const panel = await page.locator(".panel.right").boundingBox();
        const apart = panel.y + panel.height <= dock.y + 1 || dock.y + dock.height <= panel.y + 1;
        expect(apart, JSON.stringify([panel, dock])).toBe(true);
        await drop(page, "part.ngc", "G1 X1 A5\n");
        await expect(page.getByRole("dialog", { name: "The service cannot read part.ngc" })).toBeVisible();
        expect(await violations(page)).toEqual([]);
      });
    });
  }
}
