// The page at the sizes of phones, and enlarged.
import { expect, open, test } from "./viewer.mjs";

async function boxes(page, selector) {
  return page
    .locator(selector)
    .evaluateAll((all) =>
      all
        .filter((one) => one.checkVisibility({ contentVisibilityAuto: true }) && one.closest("details:not([open]) .items") === null)
        .map((one) => one.getBoundingClientRect().toJSON()),
    );
}

function overlap(a, b) {
  return a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 1 && b.top < a.bottom - 1;
}

for (const [name, viewport] of [
  ["a phone", { width: 390, height: 844 }],
  ["a phone in landscape", { width: 844, height: 390 }],
  ["a desk at 200 %", { width: 640, height: 360 }],
  ["a narrow phone", { width: 320, height: 640 }],
  ["a tablet on end", { width: 768, height: 1024 }],
]) {
  test.describe(name, () => {
    test.use({ viewport });

    test("has no controls over each other and does not scroll sideways", async ({ page }) => {
      await open(page);
      await expect(page.getByTestId("volume")).toBeAttached();
      for (const part of [".top h1, .top select, .top .button, .top button, .top .provenance", ".below button, .caption"]) {
        const found = await boxes(page, part);
        expect(found.length).toBeGreaterThan(5);
        for (const [i, a] of found.entries()) {
          for (const b of found.slice(i + 1)) expect(overlap(a, b), JSON.stringify([a, b])).toBe(false);
          expect(a.right).toBeLessThanOrEqual(viewport.width);
        }
      }
      await page.locator("summary", { hasText: "Copy" }).click();
      const { x, width } = await page.locator(".menu .items").boundingBox();
      expect(x).toBeGreaterThanOrEqual(0);
      expect(x + width).toBeLessThanOrEqual(viewport.width);
      expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(viewport.width);
    });
  });
}

test.describe("a low page", () => {
  test.use({ viewport: { width: 844, height: 390 } });

  test("has its scene beside the panels, and keeps it in sight", async ({ page }) => {
    await open(page);
    const scene = page.locator(".scene");
    const before = await scene.boundingBox();
    expect(before.height).toBeGreaterThan(300);
    await page.getByRole("heading", { name: "Workspace" }).scrollIntoViewIfNeeded();
    const after = await scene.boundingBox();
    expect(Math.abs(after.y - before.y)).toBeLessThan(2);
    expect(after.x + after.width).toBeLessThan((await page.getByRole("heading", { name: "Workspace" }).boundingBox()).x);
  });
});

test("while a file is dragged over the page, no label stands above the overlay", async ({ page }) => {
  await open(page);
  const label = await page.locator(".label", { hasText: "slider 1" }).boundingBox();
  const transfer = await page.evaluateHandle(() => new DataTransfer());
  await page.dispatchEvent("body", "dragover", { dataTransfer: transfer });
  await expect(page.getByText("Drop a program, or a machine’s JSON file")).toBeVisible();
  const top = await page.evaluate(([x, y]) => {
    // What does not take the pointer is not found by its place.
    for (const part of document.querySelectorAll(".dropping, .label")) part.style.pointerEvents = "auto";
    return document.elementFromPoint(x, y).className;
  }, [label.x + label.width / 2, label.y + label.height / 2]);
  expect(top).toBe("dropping");
});
