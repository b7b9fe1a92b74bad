// The machine moves as it is told, and says why it does not.
import { ask, expect, figure, open, pointOf, test } from "./viewer.mjs";

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
  // The value stays to be corrected, and the scene names the place.
  await expect(x).toHaveValue("900");
  await expect(x).toHaveAttribute("aria-invalid", "true");
  await expect(page.locator(".label", { hasText: "wanted here: cannot be reached" })).toBeVisible();
  await page.getByRole("button", { name: "Discard" }).click();
  await expect(x).toHaveValue("120.0");
  await expect(x).toHaveAttribute("aria-invalid", "false");
  await expect(page.locator(".label", { hasText: "wanted here" })).toBeHidden();
});

test("two values that are out of reach only one by one are typed one after the other", async ({ page, request }) => {
  await open(page);
  const typed = async (label, value) => {
    await page.getByLabel(label).fill(String(value));
    await page.getByLabel(label).press("Enter");
  };
  await typed("X on the part, mm", 900);
  await expect(page.getByTestId("trouble")).toHaveText(/^Out of reach/);
  await typed("Y on the part, mm", 10);
  await expect(page.getByLabel("X on the part, mm")).toHaveValue("900.0");
  await typed("X on the part, mm", 20);
  await expect(page.getByTestId("trouble")).toHaveText(/^Drag/);
  const pose = { x: 20, y: 10, z: 404.9, phi1: 0, phi2: 0 };
  const { solutions } = await ask(request, "/ik", { pose, tool_length: 50 });
  const reached = Math.round(solutions[0].joints.rho[0]);
  const rho1 = page.getByRole("slider", { name: "Slider 1, mm" });
  await expect.poll(async () => Math.abs(Number(await rho1.inputValue()) - reached)).toBeLessThanOrEqual(1);
});

test.describe("a value that the service does not accept", () => {
  test.use({ provoked: [/status of 422/] });

  test("has its reason at the field", async ({ page }) => {
    await open(page);
    const x = page.getByLabel("X on the part, mm");
    await x.fill("1e12");
    await x.press("Enter");
    await expect(x).toHaveAttribute("aria-invalid", "true");
    await expect(page.locator(".fault")).toHaveText(/^X: .*\d/);
    await expect(x).toHaveAccessibleDescription(/^X: /);
    await expect(page.getByText("see errors")).toHaveCount(0);
  });
});

test("a slider's value out of its stroke stays in the field with the stroke", async ({ page }) => {
  await open(page);
  const typed = page.getByLabel("Slider 1, typed, mm");
  await typed.fill("900");
  await typed.press("Enter");
  await expect(typed).toHaveValue("900");
  await expect(page.locator(".fault")).toHaveText("ρ₁: from 0 to 750\u00a0mm");
  await typed.press("Escape");
  await expect(page.locator(".fault")).toHaveCount(0);
});

test("a user drags the tool by its arrows", async ({ page }) => {
  await open(page);
  const z = page.getByLabel("Z above the table, mm");
  const before = Number(await z.inputValue());
  // The picture that stays tells where the tip is.
  await page.locator("canvas[data-picture=good]").waitFor();
  // The arrow upwards stands on the tip, which home puts near the middle.
  const [u, v] = await pointOf(page, "tip");
  const from = [u, v - 28];
  await page.mouse.move(...from);
  await page.mouse.down();
  await page.mouse.move(from[0], from[1] - 10);
  await page.mouse.move(from[0], from[1] - 30);
  await page.mouse.up();
  await expect.poll(async () => Number(await z.inputValue())).toBeGreaterThan(before + 10);
});

test("no press of a key is lost, and the jog buttons move by the chosen step", async ({ page }) => {
  await open(page, "#joints=400,450,420,0,0");
  const slider = page.getByRole("slider", { name: "Slider 1, mm" });
  await slider.focus();
  for (let i = 0; i < 60; i += 1) await page.keyboard.press("ArrowRight");
  await expect(page).toHaveURL(/#joints=460,450,420,0,0/);
  const fine = page.getByRole("radio", { name: "0.1", exact: true });
  await fine.check();
  const more = page.getByRole("button", { name: "Slider 1: plus 0.1 mm" });
  for (let i = 0; i < 12; i += 1) await more.click();
  await expect(page.getByLabel("Slider 1, typed, mm")).toHaveValue("461.2");
  await page.getByRole("radio", { name: "10", exact: true }).check();
  await page.getByRole("button", { name: "Table tilt: minus 10 degrees" }).click();
  await expect(page).toHaveURL(/#joints=461.2,450,420,-10,0/);
  // The end of the stroke holds.
  for (let i = 0; i < 40; i += 1) await page.getByRole("button", { name: "Slider 2: plus 10 mm" }).click();
  await expect(page.getByLabel("Slider 2, typed, mm")).toHaveValue("750.0");
});

test("each slider shows how far its joint can move alone, and what stops it", async ({ page, request }) => {
  await open(page, "#joints=400,450,420,0,0");
  const slider = page.getByRole("slider", { name: "Slider 1, mm" });
  await expect(slider).toHaveAttribute("title", /^Alone, it can move from .* to /);
  const title = await slider.getAttribute("title");
  const [low, high] = [...title.matchAll(/(?:from|to) ([\d.]+)/g)].map(([, number]) => Number(number));
  expect(low).toBeLessThan(400);
  expect(high).toBeGreaterThan(400);
  // The ends hold, and farther out the service finds a broken limit.
  const rows = [low + 1, high - 1, low - 1, high + 1].map((rho1) => [rho1, 450, 420, 0, 0]);
  const { status } = await ask(request, "/fk/batch", { joints: rows, tool_length: 50, table_clearance: 0 });
  expect(status.slice(0, 2)).toEqual(["ok", "ok"]);
  expect(status.slice(2)).not.toContain("ok");
});

test("undo and redo lead back and forth through moves and tools", async ({ page }) => {
  await open(page, "#joints=400,450,420,0,0");
  const undo = page.getByRole("button", { name: "Undo" });
  const redo = page.getByRole("button", { name: "Redo" });
  await expect(undo).toBeDisabled();
  const tilt = page.getByLabel("Table tilt, typed, degrees");
  await tilt.fill("-15");
  await tilt.press("Enter");
  await expect(page).toHaveURL(/#joints=400,450,420,-15,0/);
  const length = page.getByLabel("Tool length, typed, mm");
  await length.fill("120");
  await length.press("Enter");
  await expect(page).toHaveURL(/tool=120/);
  await undo.click();
  await expect(page).not.toHaveURL(/tool=/);
  await expect(tilt).toHaveValue("-15.0");
  await page.keyboard.press("Control+z");
  await expect(tilt).toHaveValue("0.0");
  await expect(undo).toBeDisabled();
  await redo.click();
  await page.keyboard.press("Control+Shift+Z");
  await expect(page).toHaveURL(/#joints=400,450,420,-15,0&tool=120/);
  await expect(redo).toBeDisabled();
});

test("a user turns the tool by the knobs of phi1 and phi2", async ({ page }) => {
  await open(page);
  await page.locator("canvas[data-picture=good]").waitFor();
  const phi2 = page.getByLabel("Azimuth phi 2, degrees");
  const from = await pointOf(page, "phi2");
  await page.mouse.move(...from);
  await page.mouse.down();
  await page.mouse.move(from[0] + 20, from[1] + 2, { steps: 4 });
  await page.mouse.up();
  await expect.poll(async () => Math.abs(Number(await phi2.inputValue()))).toBeGreaterThan(3);
  await expect(page).not.toHaveURL(/camera=/);
  const phi1 = page.getByLabel("Inclination phi 1, degrees");
  await page.locator("canvas[data-picture=good]").waitFor();
  const top = await pointOf(page, "phi1");
  await page.mouse.move(...top);
  await page.mouse.down();
  await page.mouse.move(top[0] + 12, top[1] + 6, { steps: 4 });
  await page.mouse.up();
  await expect.poll(async () => Math.abs(Number(await phi1.inputValue()))).toBeGreaterThan(1);
});

test("the camera that keys have moved is in the link", async ({ page }) => {
  await open(page);
  await page.locator("canvas").focus();
  await page.keyboard.press("Shift+ArrowLeft");
  await expect(page).toHaveURL(/camera=/);
});
