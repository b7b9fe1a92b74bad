// The pages need nothing that the service's content security policy forbids: the console stays clean.
import { expect, open, test } from "./viewer.mjs";

test("the viewer works without inline scripts, inline styles and eval", async ({ page }) => {
  const response = await page.request.get("/");
  const policy = response.headers()["content-security-policy"];
  expect(policy).toContain("script-src 'self';");
  expect(policy).not.toContain("unsafe");
  await open(page, "#joints=400,450,420,0,0&ghosts=assembly&section=300");
  await expect(page.getByTestId("slice-area")).toBeVisible();
  await expect(page.getByTestId("ghost-count")).toHaveText("4");
  await expect(page.locator(".legend li").first()).toBeVisible();
});

test("the docs show an operation and send its request", async ({ page }) => {
  await page.goto("/docs/");
  await page.locator("#operations-service-get_livez").click();
  await page.getByRole("button", { name: "Try it out" }).click();
  await page.getByRole("button", { name: "Execute" }).click();
  await expect(page.locator(".live-responses-table tbody .response-col_status").first()).toContainText("200");
});
