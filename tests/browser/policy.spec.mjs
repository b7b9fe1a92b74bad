// The page needs nothing that a strict content security policy forbids.
import { expect, open, test } from "./viewer.mjs";

const POLICY = [
  "default-src 'none'",
  "script-src 'self'",
  "style-src 'self'",
  "img-src 'self' data: blob:",
  "connect-src 'self'",
].join("; ");

test("the viewer works without inline scripts, inline styles and eval", async ({ page }) => {
  await page.route("**/*", async (route) => {
    if (route.request().resourceType() !== "document") return route.continue();
    const response = await route.fetch();
    await route.fulfill({
      response,
      headers: { ...response.headers(), "content-security-policy": POLICY },
    });
  });
  await open(page, "#joints=400,450,420,0,0&ghosts=assembly&section=300");
  await expect(page.getByTestId("slice-area")).toBeVisible();
  await expect(page.getByTestId("ghost-count")).toHaveText("4");
  await expect(page.locator(".legend li").first()).toBeVisible();
});
