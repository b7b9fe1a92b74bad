// What the page explains.
import { expect, open, test } from "./viewer.mjs";

test("symbols have tooltips, and a panel explains them beside the drawing of the frames", async ({ page }) => {
  await open(page);
  await expect(page.locator(".name", { hasText: /^φ₁$/ }).first()).toHaveAttribute("title", /inclination.*φ₁ = α − θ₁/);
  await page.getByRole("button", { name: "Help" }).click();
  const help = page.getByRole("dialog", { name: "Symbols, frames and controls" });
  for (const symbol of ["ρ₁", "θ₂", "α", "φ₂"]) {
    await expect(help.getByRole("rowheader", { name: symbol })).toBeVisible();
  }
  await expect(help.getByText("the two rods of leg 1 cross each other")).toBeVisible();
  const errors = help.getByRole("region", { name: "Errors of the tool" });
  for (const field of ["Rods", "Sliders", "Joints", "Axes", "Angles"])
    await expect(errors.getByText(field, { exact: true })).toBeVisible();
  await expect(help.getByRole("region", { name: "Map of solutions" })).toContainText("where solutions merge");
  const drawing = help.getByRole("img", { name: /z points down/ });
  // It is loaded when it is seen.
  await expect.poll(() => drawing.evaluate((image) => image.naturalWidth)).toBeGreaterThan(100);
  await page.keyboard.press("Escape");
  await expect(help).toBeHidden();
});

test("the version, the paper, the licence and the guide stand in one panel", async ({ page, request }) => {
  await open(page);
  await page.getByRole("button", { name: "About" }).click();
  const { info } = await (await request.get("/openapi.json")).json();
  const about = page.getByRole("dialog", { name: `verne ${info.version}` });
  await expect(about).toContainText("D. Kanaan, P. Wenger, D. Chablat");
  await expect(about.getByRole("link", { name: "arXiv:0707.3507" })).toBeVisible();
  await expect(about).toContainText("MIT or Apache-2.0");
  await expect(about.getByRole("link", { name: "Guide" })).toHaveAttribute("href", "guide");
});

test("what is not checked stands beside the margins", async ({ page }) => {
  await open(page);
  await expect(page.getByText("all kept")).toBeVisible();
  await expect(page.getByTestId("not-checked")).toHaveText("Not checked: the part, fixtures.");
});
