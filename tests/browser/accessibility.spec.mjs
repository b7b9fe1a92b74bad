// WCAG, with everything shown.
import { expectAccessible, inEveryLook } from "./looks.mjs";
import { drop, expect, open, test } from "./viewer.mjs";

test.use({ provoked: [/status of 422/] });

test("the page and its dialogs have no accessibility violations", async ({ page }) => {
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
  await inEveryLook(page, "page", () => expectAccessible(page));
  await page.keyboard.press("Escape");
  await page.getByRole("button", { name: "Help" }).click();
  await expect(page.getByRole("dialog")).toBeVisible();
  await inEveryLook(page, "help", () => expectAccessible(page));
  await page.keyboard.press("Escape");
  await drop(page, "broken.json", '{"name": "x"}');
  await expect(page.getByRole("dialog")).toBeVisible();
  await inEveryLook(page, "faults", () => expectAccessible(page));
});
