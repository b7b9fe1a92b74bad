// A dexterity map in the scene: its layers, figures and colours.
import { expectAccessible, expectNothingOverflows, inEveryLook } from "./looks.mjs";
import { ask, expect, open, test } from "./viewer.mjs";

async function openMap(page, view = "") {
  await open(page, view);
  await page.getByRole("heading", { name: "Dexterity map" }).click();
  const cell = page.getByLabel("Distance between points, mm");
  await cell.fill("80");
  await cell.press("Enter");
}

const points = (page) =>
  page
    .locator(".dexterity td")
    .allTextContents()
    .then((texts) => texts.reduce((sum, text) => sum + Number(text.replace(/\D/g, "")), 0));

test("the layers have the points of the service; a slider chooses the layer", async ({ page, request }) => {
  await openMap(page);
  await page.getByRole("button", { name: "Compute the map" }).click();
  await expect(page.getByTestId("map-caption")).toHaveText(/^φ₁ from −20\.0° to 20\.0°, φ₂ 0\.0°, tool 50\.0.mm$/);
  await expect(page.getByTestId("map-scene-caption")).toHaveText(/^Dexterity map at 400\.0.mm over the table, φ₁ from/);
  const canvas = page.locator("canvas[data-ready=yes]");
  const slider = page.getByRole("slider", { name: "Height of the layer over the table" });
  await slider.press("Home");
  const lowest = Number(await canvas.getAttribute("data-layers"));
  await slider.press("ArrowRight");
  await expect(canvas).toHaveAttribute("data-layers", String(lowest + 80));
  await expect(slider).toHaveAttribute("aria-valuetext", new RegExp(`^${(lowest + 80).toFixed(1)}`));

  const settings = { tool_length: 50, phi1: { from: -20, to: 20 }, cell: 80, table_clearance: 0, tool_radius: 0 };
  const summary = await ask(request, "/workspace/dexterity", settings);
  await page.getByRole("group", { name: "Layers" }).getByLabel("all").check({ force: true });
  expect(await points(page)).toBe(summary.reached);
  await expect(page.locator(".dexterity dd").first()).toContainText((summary.reachable.volume / 1e9).toFixed(6));
  if (process.env.PICTURES) await page.screenshot({ path: `${process.env.PICTURES}/map-all.png` });
  await page.getByLabel("show the map").uncheck();
  await expect(canvas).toHaveAttribute("data-layers", "");

  // Other settings are told.
  const length = page.getByLabel("Tool length, typed, mm");
  await length.fill("60");
  await length.press("Enter");
  await expect(page.getByTestId("map-caption")).toHaveText(/^Other settings than those of the page: /);
});

test("the link has the section with its settings", async ({ page }) => {
  await openMap(page);
  const last = page.getByLabel("Last inclination, degrees");
  await last.fill("35");
  await last.press("Enter");
  await expect(page).toHaveURL(/[#&]dexterity=-20,35,80$/);
  await page.reload();
  await expect(last).toHaveValue("35.0");
  await expect(page.getByLabel("Distance between points, mm")).toHaveValue("80.0");
  await expect(page.getByRole("button", { name: "Compute the map" })).toBeEnabled();
  await page.getByRole("heading", { name: "Dexterity map" }).click();
  await expect(page).not.toHaveURL(/dexterity/);
});

test("a long map can be cancelled", async ({ page }) => {
  await openMap(page, "#workspace=hidden");
  const cell = page.getByLabel("Distance between points, mm");
  await cell.fill("10");
  await cell.press("Enter");
  await page.getByRole("button", { name: "Compute the map" }).click();
  const panel = page.locator(".dexterity");
  await expect(panel.locator(".progress")).toContainText("%");
  await panel.getByRole("button", { name: "Cancel" }).click();
  await expect(panel.getByText("Cancelled.")).toBeVisible();
});

test("a map has no accessibility violations, and nothing overflows", async ({ page }) => {
  await openMap(page);
  await page.getByRole("button", { name: "Compute the map" }).click();
  await expect(page.getByTestId("layer-height")).toBeVisible();
  await inEveryLook(page, "dexterity", async () => {
    await page.locator(".dexterity table").scrollIntoViewIfNeeded();
    await expectAccessible(page, ".dexterity");
    await expectNothingOverflows(page, ".dexterity");
  });
});
