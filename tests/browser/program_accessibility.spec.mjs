// A program by WCAG, and where its parts stand.
import { readFileSync } from "node:fs";
import { resolve } from "node:path";
import { expectAccessible, expectNothingOverflows, inEveryLook, scrollUp } from "./looks.mjs";
import { drop, expect, open, test } from "./viewer.mjs";

const DOME = readFileSync(resolve(import.meta.dirname, "../../examples/dome.cls"), "utf8");

test.use({ provoked: [/status of 422/] });

test("a program that fails has no accessibility violations, and nothing overflows", async ({ page }) => {
  await open(page, "#workspace=hidden");
  await drop(page, "dome.cls", DOME);
  await expect(page.getByText("12 stretches fail")).toBeVisible();
  await page.getByText("Tolerances and motion").click();
  await page.getByText("One warning").click();
  await page.getByRole("button", { name: "Show all 12" }).click();
  await inEveryLook(page, "program", async () => {
    await scrollUp(page);
    await expectAccessible(page);
    await expectNothingOverflows(page, ".dock", ".program");
    // The scene covers nothing of the motion.
    await scrollUp(page);
    const [scene, dock] = [await page.locator(".scene").boundingBox(), await page.locator(".dock").boundingBox()];
    const beside = scene.x + scene.width <= dock.x + 1 || scene.y + scene.height <= dock.y + 1;
    expect(beside, JSON.stringify([scene, dock])).toBe(true);
    const panel = await page.locator(".panel.right").boundingBox();
    const apart = panel.y + panel.height <= dock.y + 1 || dock.y + dock.height <= panel.y + 1;
    expect(apart, JSON.stringify([panel, dock])).toBe(true);
  });
  await drop(page, "part.ngc", "G1 X1 A5\n");
  await expect(page.getByRole("dialog", { name: "The service cannot read part.ngc" })).toBeVisible();
  await inEveryLook(page, "reading", () => expectAccessible(page));
});
