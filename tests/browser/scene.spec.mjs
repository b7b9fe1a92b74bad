// How the scene is seen, measured and taken along.
import { readFileSync } from "node:fs";
import { ask, expect, open, pointOf, test } from "./viewer.mjs";

for (const side of ["Front", "Side", "Top"]) {
  test(`${side} has no perspective, and the link keeps it`, async ({ page }) => {
    await open(page);
    await page.getByRole("button", { name: side, exact: true }).click();
    const canvas = page.locator("canvas");
    await expect(canvas).toHaveAttribute("data-camera", "parallel");
    await expect(page).toHaveURL(/camera=([-\d.]+,){6}[\d.]+/);
    const address = page.url();
    await page.getByRole("button", { name: "Whole" }).click();
    await expect(canvas).toHaveAttribute("data-camera", "perspective");
    await expect(page).not.toHaveURL(/camera=/);
    await page.goto("about:blank");
    await page.goto(address);
    await page.locator("canvas[data-ready=yes]").waitFor();
    await expect(canvas).toHaveAttribute("data-camera", "parallel");
  });
}

test("no label covers another one", async ({ page }) => {
  for (const side of ["Whole", "Front", "Side", "Top"]) {
    await open(page, "#joints=674,685,250,0,0&ghosts=platform");
    await expect(page.getByTestId("ghost-count")).not.toHaveText("0");
    const before = await page.locator("canvas").getAttribute("data-pictures");
    await page.getByRole("button", { name: side, exact: true }).click();
    await expect(page.locator("canvas")).not.toHaveAttribute("data-pictures", before);
    await page.locator("canvas[data-picture=good]").waitFor();
    const boxes = await page.locator(".labels .label:visible").evaluateAll((labels) =>
      labels.map((label) => label.getBoundingClientRect().toJSON()),
    );
    expect(boxes.length).toBeGreaterThan(5);
    for (const [i, a] of boxes.entries()) {
      for (const b of boxes.slice(i + 1)) {
        const apart =
          a.x + a.width <= b.x + 1 || b.x + b.width <= a.x + 1 || a.y + a.height <= b.y + 1 || b.y + b.height <= a.y + 1;
        expect(apart, `${side}: ${JSON.stringify([a, b])}`).toBe(true);
      }
    }
  }
});

test("the distance between two points is measured", async ({ page, request }) => {
  await open(page, "#joints=400,450,420,0,0&workspace=hidden");
  await page.getByRole("button", { name: "Front", exact: true }).click();
  await page.getByRole("button", { name: "Measure" }).click();
  const result = page.getByTestId("measurement");
  await expect(result).toContainText("Click two points");
  await page.locator("canvas[data-picture=good]").waitFor();
  // The tip and the platform's point attract the pointer; the tool's length is between them.
  const { solutions } = await ask(request, "/fk", { joints: { rho: [400, 450, 420] }, tool_length: 50 });
  const { platform, tool } = solutions[0];
  const [x, y] = await pointOf(page, "tip");
  await page.mouse.click(x, y);
  const { height } = await page.locator("canvas").boundingBox();
  const tall = Number(new URL(page.url()).hash.match(/camera=([^&]*)/)[1].split(",")[6]);
  const pixels = height / tall / 1000;
  await page.mouse.click(x + (platform.x - tool.x) * pixels, y + (platform.z - tool.z) * pixels);
  await expect(result).toHaveText(/^50\.0.mm: x /);
  await expect(page.locator(".label.measure")).toHaveText("50.0\u00a0mm");
  await page.locator("canvas").press("Escape");
  await expect(result).toHaveCount(0);
});

test("the scene is saved as a picture", async ({ page }) => {
  await open(page);
  const download = page.waitForEvent("download");
  await page.getByRole("button", { name: "Picture" }).click();
  const file = await download;
  expect(file.suggestedFilename()).toBe("verne.png");
  const bytes = readFileSync(await file.path());
  expect(bytes.subarray(1, 4).toString()).toBe("PNG");
  const { width } = await page.locator("canvas").boundingBox();
  expect(bytes.readUInt32BE(16)).toBe(2 * Math.round(width));
  expect(bytes.length).toBeGreaterThan(30_000);
});

test("link, JSON and commands are copied, and the commands give what the page shows", async ({
  page,
  context,
  request,
}) => {
  await context.grantPermissions(["clipboard-read", "clipboard-write"]);
  await open(page, "#joints=400,450,420,-5,10&tool=80");
  await expect(page.getByTestId("volume")).toBeVisible();
  const copied = async (name) => {
    await page.locator("summary", { hasText: "Copy" }).click();
    await page.getByRole("button", { name }).click();
    await expect(page.getByText(`Copied: ${name}`)).toBeVisible();
    return page.evaluate(() => navigator.clipboard.readText());
  };
  expect(await copied("Link to this view")).toMatch(/#joints=400,450,420,-5,10&tool=80$/);
  const pose = JSON.parse(await copied("Pose as JSON"));
  expect(pose.joints).toEqual({ rho: [400, 450, 420], theta1: -5, theta2: 10 });
  const body = (command) => JSON.parse(/ -d '(.*)'$/.exec(command)[1]);
  const fk = await copied("Pose as a curl command");
  expect(fk).toMatch(/^curl 'http:.*\/fk' /);
  const { solutions } = await ask(request, "/fk", body(fk));
  expect(solutions[0].platform).toEqual(pose.platform);
  const { id } = await ask(request, "/workspace", body(await copied("Workspace as a curl command")));
  await expect(page.getByRole("link", { name: "GLB" })).toHaveAttribute("href", new RegExp(id));
});
