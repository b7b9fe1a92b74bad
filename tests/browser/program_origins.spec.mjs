// The region of origins: in words and in the scene, outdated when another setting changes.
import { readFileSync } from "node:fs";
import { resolve } from "node:path";
import { expectAccessible, expectNothingOverflows, inEveryLook, scrollUp } from "./looks.mjs";
import { drop, expect, open, test } from "./viewer.mjs";

const HELIX = readFileSync(resolve(import.meta.dirname, "../../examples/helix.ngc"), "utf8");
const LINE = "UNITS/MM\nFEDRAT/600,MMPM\nGOTO/-100,0,300\nGOTO/100,0,300\n";

const toggle = (page) => page.getByRole("button", { name: "Region of origins", exact: true });
const region = (page) => page.getByTestId("region");
const drawn = (page) => page.locator("canvas[data-origins]");

async function program(page, name, text) {
  await open(page, "#workspace=hidden&tool=100");
  await drop(page, name, text);
  await expect(page.getByTestId("verdict")).toBeVisible();
}

async function setCell(page, mm) {
  const cell = page.getByLabel("Cell of the region of origins, mm");
  await cell.fill(mm);
  await cell.press("Enter");
}

test("the region is shown with its volume and a mark, and put away", async ({ page }) => {
  await program(page, "line.cls", LINE);
  await setCell(page, "80");
  await toggle(page).click();
  await expect(region(page)).toContainText(/\d+.litres \(± [\d.]+.litres\), within x .* to /);
  await expect(drawn(page)).toHaveCount(1);
  const mark = page.getByText("origin of the set-up", { exact: true });
  await expect(mark).toBeVisible();
  // The origin moves within the region; a turn makes it another one.
  const x = page.getByLabel("Set-up: x, mm");
  await x.fill("30");
  await x.press("Enter");
  await expect(page.getByTestId("outdated")).toHaveCount(0);
  await expect(region(page)).toBeVisible();
  const turn = page.getByLabel("Set-up: turn about z, degrees");
  await turn.fill("30");
  await turn.press("Enter");
  await expect(page.getByText("The region is that of other settings.")).toBeVisible();
  await page.getByRole("button", { name: "Compute again" }).click();
  await expect(region(page)).toBeVisible();
  await toggle(page).press("Enter");
  await expect(drawn(page)).toHaveCount(0);
  await expect(mark).toBeHidden();
});

test("a program with no place for its origin is told so", async ({ page }) => {
  await program(page, "far.cls", "UNITS/MM\nFEDRAT/600,MMPM\nGOTO/-2000,0,300\nGOTO/2000,0,300\n");
  await setCell(page, "80");
  await toggle(page).click();
  await expect(region(page)).toHaveText("No origin was found with which the machine can follow the program.");
  await expect(drawn(page)).toHaveCount(0);
});

test("a computation is cancelled", async ({ page }) => {
  await program(page, "helix.ngc", HELIX);
  await setCell(page, "10");
  await toggle(page).click();
  const part = page.locator(".origins");
  await expect(part.getByText(/^Computing the region of origins … \d+ %/)).toBeVisible();
  await part.getByRole("button", { name: "Cancel" }).click();
  await expect(part.getByText("Cancelled.")).toBeVisible();
  await expect(toggle(page)).toHaveAttribute("aria-pressed", "false");
});

test("the region has no accessibility violations, and nothing overflows", async ({ page }) => {
  await program(page, "line.cls", LINE);
  await setCell(page, "80");
  await toggle(page).click();
  await expect(drawn(page)).toHaveCount(1);
  await inEveryLook(page, "origins", async () => {
    await scrollUp(page);
    await expectAccessible(page);
    await expectNothingOverflows(page, ".program");
  });
});
