// Every solution can be seen and taken.
import { ask, expect, figure, open, test } from "./viewer.mjs";

test("the four assembly modes of the paper's Fig. 6 are shown, and a user selects one", async ({
  page,
  request,
}) => {
  await open(page, "#joints=674,685,250,0,0");
  await page.getByRole("radio", { name: "sliders", exact: true }).check();
  const list = page.getByRole("list", { name: "Assembly modes" });
  await expect(list.getByRole("listitem")).toHaveCount(4);
  const { solutions } = await ask(request, "/fk", {
    joints: { rho: [674, 685, 250], theta1: 0, theta2: 0 },
    tool_length: 50,
    solutions: "all",
  });
  const other = solutions.findIndex(({ working }) => !working);
  const ghost = list.getByRole("button").nth(other);
  await ghost.click();
  await expect(ghost).toHaveAttribute("aria-pressed", "true");
  await expect(figure(page, "Platform tilt")).toHaveText(
    `${solutions[other].platform.alpha.toFixed(2).replace("-", "−")}°`,
  );

  // Its slider moves it within its mode.
  await page.getByRole("slider", { name: "Slider 1, mm" }).press("ArrowLeft");
  await expect(page).toHaveURL(/#joints=673,685,250,0,0&mode=/);
  const moved = await ask(request, "/fk", {
    joints: { rho: [673, 685, 250] },
    solutions: "all",
    near: solutions[other].platform,
  });
  await expect(figure(page, "Platform tilt")).toHaveText(
    `${moved.solutions[0].platform.alpha.toFixed(2).replace("-", "−")}°`,
  );
});

test("the sixteen inverse solutions of the paper's Fig. 5 are shown", async ({ page }) => {
  await open(page, "#joints=287.7175,4.604,94.2422,0,0&ghosts=platform");
  const list = page.getByRole("list", { name: "Inverse solutions" });
  await expect(list.getByRole("listitem")).toHaveCount(16);
  await expect(list.getByText("working", { exact: true })).toHaveCount(1);
});

test("every inverse solution of the tool's pose is shown, and a user selects one", async ({ page, request }) => {
  await open(page, "#joints=287.718,4.604,94.242,0,0&tool=0&ghosts=inverse");
  const list = page.getByRole("list", { name: "Inverse solutions" });
  await expect(list.getByRole("listitem")).not.toHaveCount(0);
  const fk = await ask(request, "/fk", { joints: { rho: [287.718, 4.604, 94.242], theta1: 0, theta2: 0 } });
  const { x, y, z, phi1, phi2 } = fk.solutions[0].part;
  const ik = await ask(request, "/ik", { pose: { x, y, z, phi1, phi2 }, solutions: "all" });
  await expect(list.getByRole("listitem")).toHaveCount(ik.solutions.length);
  await list.getByRole("button").last().click();
  await expect(list.getByRole("button").last()).toHaveAttribute("aria-pressed", "true");
});

test("solutions are numbered in the list as in the scene, feasible ones first; their words are explained", async ({
  page,
}) => {
  await open(page, "#joints=674,685,250,0,0&ghosts=assembly&workspace=hidden");
  const list = page.getByRole("list", { name: "Assembly modes" });
  await expect(list.getByRole("listitem")).toHaveCount(4);
  const broken = await list.locator(".index").evaluateAll((all) => all.map((one) => one.classList.contains("broken")));
  expect(broken).toEqual([...broken].sort());
  expect(broken[0]).toBe(false);
  // The machine itself stands at the first; the ghosts have the numbers of the list.
  const numbers = page.locator(".label.ghost:visible");
  await expect(numbers).toHaveText(["2", "3", "4"]);
  for (const reason of await list.locator(".reason").allTextContents()) expect(reason).toMatch(/too far|below|cross|too/);
  await page.getByText("Colours and words").click();
  await expect(page.locator(".words").getByText("the two rods of leg 1 cross each other")).toBeVisible();
});

test("the whole is seen with its ghosts", async ({ page }) => {
  await open(page, "#joints=674,685,250,0,0&ghosts=assembly&workspace=hidden");
  await expect(page.getByTestId("ghost-count")).toHaveText("4");
  const before = await page.locator("canvas").getAttribute("data-pictures");
  await page.getByRole("button", { name: "Whole" }).click();
  await expect(page.locator("canvas")).not.toHaveAttribute("data-pictures", before);
  await page.locator("canvas[data-picture=good]").waitFor();
  const scene = await page.locator(".scene").boundingBox();
  for (const number of await page.locator(".label.ghost:visible").all()) {
    const { x, y, width, height } = await number.boundingBox();
    expect(x).toBeGreaterThan(scene.x);
    expect(y).toBeGreaterThan(scene.y);
    expect(x + width).toBeLessThan(scene.x + scene.width);
    expect(y + height).toBeLessThan(scene.y + scene.height);
  }
});
