// The machine moves as it is told, and says why it does not.
import { ask, expect, figure, open, test } from "./viewer.mjs";

test("the page opens with the machine in its workspace", async ({ page }) => {
  await open(page);
  await expect(page.getByTestId("volume")).toHaveText(/^0\.300444.m³$/);
  await expect(page.getByTestId("margins").getByRole("listitem").first()).toHaveText(
    /slider 1 is 343\.7.mm from its upper end/,
  );
  await expect(page.getByText("invented round dimensions, not Fatronik’s")).toBeVisible();
});

test("a slider moves the machine through /fk, also by keyboard", async ({ page, request }) => {
  await open(page, "#joints=400,450,420,0,0");
  const before = await page.locator("canvas").getAttribute("data-pictures");
  await page.getByRole("slider", { name: "Slider 2, mm" }).press("ArrowRight");
  const { solutions } = await ask(request, "/fk", {
    joints: { rho: [400, 451, 420], theta1: 0, theta2: 0 },
    tool_length: 50,
  });
  const { alpha } = solutions[0].platform;
  await expect(figure(page, "Platform tilt")).toHaveText(`${alpha.toFixed(2).replace("-", "−")}°`);
  await expect(page.locator("canvas")).not.toHaveAttribute("data-pictures", before);
  await expect(page).toHaveURL(/#joints=400,451,420,0,0/);
});

test("a typed pose moves the machine through /ik; an unreachable pose shows the reason", async ({
  page,
  request,
}) => {
  await open(page);
  const x = page.getByLabel("X on the part, mm");
  await x.fill("120");
  await x.press("Enter");
  const pose = { x: 120, y: 0, z: 404.9, phi1: 0, phi2: 0 };
  const { solutions } = await ask(request, "/ik", { pose, tool_length: 50 });
  const rho1 = page.getByRole("slider", { name: "Slider 1, mm" });
  const reached = Math.round(solutions[0].joints.rho[0]);
  await expect.poll(async () => Math.abs(Number(await rho1.inputValue()) - reached)).toBeLessThanOrEqual(1);
  const stood = await rho1.inputValue();

  await x.fill("900");
  await x.press("Enter");
  await expect(page.getByTestId("trouble")).toHaveText(
    /^Out of reach: leg \d too short by [\d\u202f.]+.mm\.$/,
  );
  expect(await rho1.inputValue()).toBe(stood);
});

test("a user drags the tool by its arrows", async ({ page }) => {
  await open(page);
  const canvas = page.locator("canvas");
  const { x, y, width, height } = await canvas.boundingBox();
  const z = page.getByLabel("Z above the table, mm");
  const before = Number(await z.inputValue());
  // The picture that stays tells where the tip is.
  await page.locator("canvas[data-picture=good]").waitFor();
  // The arrow upwards stands on the tip, which home puts near the middle.
  const tip = await page.evaluate(() => document.querySelector("canvas").dataset.tip);
  const [u, v] = tip.split(",").map(Number);
  const from = [x + ((u + 1) / 2) * width, y + ((1 - v) / 2) * height - 28];
  await page.mouse.move(...from);
  await page.mouse.down();
  await page.mouse.move(from[0], from[1] - 10);
  await page.mouse.move(from[0], from[1] - 30);
  await page.mouse.up();
  await expect.poll(async () => Number(await z.inputValue())).toBeGreaterThan(before + 10);
});
