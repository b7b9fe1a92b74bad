// The map of solutions: regions as the service counts them, and the machine's place.
import { expectAccessible, expectNothingOverflows, inEveryLook } from "./looks.mjs";
import { ask, expect, open, test } from "./viewer.mjs";

const HEADING = "Map of solutions";
const map = (page) => page.getByTestId("atlas-map");
const here = (page) => page.getByTestId("atlas-here");
const dot = (page) => page.getByTestId("atlas-dot");

/** A point of the plane, seen; `down` is 1 where v points down. */
async function seen(page, [u, v], down) {
  return map(page).evaluate(
    (svg, [x, y]) => {
      const at = new DOMPoint(x, y).matrixTransform(svg.getScreenCTM());
      return [at.x, at.y];
    },
    [u, v * down],
  );
}

test("the map of the platform has the numbers of the service, and a click leads the machine there", async ({
  page,
  request,
}) => {
  await open(page, "#workspace=hidden");
  await page.getByRole("heading", { name: HEADING }).click();
  const { regions } = await ask(request, "/atlas", { space: "platform" });
  const numbers = [...new Set(regions.map(({ solutions }) => solutions))].sort((a, b) => a - b);
  const words = numbers.map((number) => (number === 0 ? "no solution" : `${number} solutions`));
  await expect(page.locator(".atlas tbody th")).toHaveText(words);
  await expect(map(page).locator("path[fill^=color-mix]")).toHaveCount(regions.length);
  await expect.poll(async () => Math.abs(Number(await dot(page).getAttribute("cx")))).toBeLessThan(0.01);

  // The number where the machine stands is that of /ik.
  const pose = { frame: "platform", pose: { x: 0, y: 0, z: 1200 }, solutions: "all" };
  const { solutions } = await ask(request, "/ik", pose);
  await expect(here(page)).toHaveText(`The machine stands where there are ${solutions.length} solutions.`);

  await map(page).scrollIntoViewIfNeeded();
  await page.mouse.click(...(await seen(page, [60, 100], 1)));
  const field = (name) => page.getByLabel(`Platform ${name} on the map, mm`);
  await expect.poll(async () => Math.abs(Number(await field("x").inputValue()) - 60)).toBeLessThan(8);
  await expect.poll(async () => Math.abs(Number(await field("y").inputValue()) - 100)).toBeLessThan(8);
  await expect.poll(async () => Math.abs(Number(await dot(page).getAttribute("cy")) - 100)).toBeLessThan(8);
  // Where there is no solution, nothing moves, and the reason is told.
  await field("x").fill("900");
  await field("x").press("Enter");
  await expect(page.locator(".atlas .trouble")).not.toBeEmpty();
});

test("the map of the sliders follows the machine, and the link has the plane", async ({ page }) => {
  await open(page, "#workspace=hidden&joints=300,400,250,0,0&atlas=joints");
  await expect(map(page)).toBeVisible();
  await expect(dot(page)).toHaveAttribute("cx", "100");
  await expect(dot(page)).toHaveAttribute("cy", "50");
  const first = page.getByLabel("Slider 1, typed, mm");
  await first.fill("350");
  await first.press("Enter");
  await expect(dot(page)).toHaveAttribute("cx", "50");
  await expect(here(page)).toHaveText("The machine stands where there are 4 solutions.");

  await map(page).scrollIntoViewIfNeeded();
  await page.mouse.click(...(await seen(page, [-80, 40], -1)));
  await expect.poll(async () => Math.abs(Number(await dot(page).getAttribute("cx")) + 80)).toBeLessThan(8);
  await expect.poll(async () => Math.abs(Number(await dot(page).getAttribute("cy")) + 40)).toBeLessThan(8);
  await page.getByRole("group", { name: "Plane of" }).getByLabel("platform").check({ force: true });
  await expect(page).not.toHaveURL(/atlas=joints/);
  await expect(page).toHaveURL(/atlas=platform/);
  await page.getByRole("heading", { name: HEADING }).click();
  await expect(page).not.toHaveURL(/atlas/);
});

test("the map has no accessibility violations, and nothing overflows", async ({ page }) => {
  await open(page, "#workspace=hidden&atlas=platform");
  await expect(map(page)).toBeVisible();
  await inEveryLook(page, "atlas", async () => {
    await map(page).evaluate((svg) => svg.scrollIntoView({ block: "end" }));
    await expectAccessible(page, ".atlas");
    await expectNothingOverflows(page, ".atlas");
  });
});
