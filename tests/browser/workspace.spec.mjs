// The workspace on the page is the one that the service computes.
import { ask, drop, expect, open, pointOf, test, value, verne } from "./viewer.mjs";

test("another tool length shows the volume of the API", async ({ page, request }) => {
  await open(page, "#phi=30,0");
  const volume = page.getByTestId("volume");
  await expect(volume).toBeVisible();
  const length = page.getByLabel("Tool length, typed, mm");
  await length.fill("200");
  await length.press("Enter");
  const asked = await ask(request, "/workspace", {
    kind: "part",
    tool_length: 200,
    phi1: 30,
    table_clearance: 0,
  });
  await expect(page.getByRole("link", { name: "GLB" })).toHaveAttribute("href", new RegExp(asked.id));
  expect(await value(volume)).toBe(asked.volume);
});

test("the workspace ends at the table, and a control sets the clearance", async ({ page, request }) => {
  await open(page, "#tool=400");
  const volume = page.getByTestId("volume");
  await expect(volume).toBeVisible();
  const question = { kind: "part", tool_length: 400 };
  const at = (table_clearance) => ask(request, "/workspace", { ...question, table_clearance });
  expect(await value(volume)).toBe((await at(0)).volume);
  expect(await value(volume)).toBeLessThan(0.7 * (await ask(request, "/workspace", question)).volume);
  await expect(page.locator(".legend li", { hasText: "as near to the table as allowed" })).toHaveCount(1);
  const least = page.getByLabel("Least height of tool and platform over the table, mm");
  await expect(least).toHaveValue("0.0");
  await least.fill("60");
  await least.press("Enter");
  const higher = await at(60);
  await expect(page.getByRole("link", { name: "GLB" })).toHaveAttribute("href", new RegExp(higher.id));
  expect(await value(volume)).toBe(higher.volume);
  await expect(page).toHaveURL(/clearance=60/);
});

test("the workspace is that of the machine's tool and angles", async ({ page, request }) => {
  await open(page);
  const volume = page.getByTestId("volume");
  await expect(volume).toBeVisible();
  await page.getByLabel("Table tilt, typed, degrees").fill("-20");
  await page.getByLabel("Table tilt, typed, degrees").press("Enter");
  const asked = await ask(request, "/workspace", {
    kind: "part",
    tool_length: 50,
    phi1: 20,
    phi2: 0,
    table_clearance: 0,
  });
  await expect(page.getByRole("link", { name: "GLB" })).toHaveAttribute("href", new RegExp(asked.id));
  await expect(page.getByTestId("caption")).toHaveText(/^Workspace on the part, tool 50\.0.mm, φ₁ 20\.0°, φ₂ 0\.0°$/);
  await expect(page.getByLabel("Tool inclination on the part, phi 1, degrees")).toHaveValue("20.0");

  // Angles of its own are told in the scene and in the link, until the workspace follows again.
  const phi1 = page.getByLabel("Tool inclination on the part, phi 1, degrees");
  await phi1.fill("10");
  await phi1.press("Enter");
  await expect(page.getByTestId("caption")).toHaveText(/φ₁ 10\.0°, φ₂ 0\.0°. The machine stands at φ₁ 20\.0°/);
  await expect(page).toHaveURL(/phi=10,0/);
  await page.getByLabel("φ₁ and φ₂ follow the machine").check();
  await expect(page.getByTestId("caption")).toHaveText(/φ₁ 20\.0°, φ₂ 0\.0°$/);
  await expect(page).not.toHaveURL(/phi=/);
});

test("while another workspace is computed, the last one is marked as outdated; it remains if cancelled", async ({
  page,
}) => {
  await open(page);
  const volume = page.getByTestId("volume");
  await expect(volume).toBeVisible();
  const before = await volume.getAttribute("value");
  let answer = () => undefined;
  await page.route("**/workspace", async (route) => {
    await new Promise((resolve) => (answer = resolve));
    await route.continue().catch(() => undefined);
  });
  const tolerance = page.getByLabel("Tolerance of the mesh");
  await tolerance.fill("2");
  await tolerance.press("Enter");
  await expect(page.getByTestId("caption")).toHaveText(/^Outdated, the new one is being computed: /);
  await page.getByTestId("progress").getByRole("button", { name: "Cancel" }).click();
  await expect(page.getByTestId("workspace-note")).toHaveText("Cancelled. The last workspace remains, in grey.");
  await expect(page.getByTestId("caption")).toHaveText(/^Outdated: /);
  expect(await volume.getAttribute("value")).toBe(before);
  answer();
  await page.unroute("**/workspace");
  await page.getByRole("button", { name: "Compute again" }).click();
  await expect(page.getByTestId("caption")).toHaveText(/^Workspace/);
});

test("a tool end below the table is refused", async ({ page }) => {
  await open(page, "#tool=400");
  const z = page.getByLabel("Z above the table, mm");
  await z.fill("-20");
  await z.press("Enter");
  await expect(page.getByTestId("trouble")).toHaveText(
    /^Not allowed: the tool’s end 20\.0.mm too low over the table\.$/,
  );
  await page.getByRole("button", { name: /^Show all/ }).click();
  await expect(page.getByTestId("margins")).toContainText(/the tool’s end can come [\d.]+.mm nearer to the table/);
});

test("the section plane shows the slice and its area, and all files can be downloaded", async ({ page, request }) => {
  await open(page, "#workspace=platform");
  await page.getByLabel("Section plane").check();
  const height = page.getByLabel("Height of the section, z down, typed, mm");
  await height.fill("1200");
  await height.press("Enter");
  const { id } = await ask(request, "/workspace", { kind: "platform" });
  const { area } = await (await request.get(`/workspace/${id}/slice?z=1200&format=json`)).json();
  await expect(page.getByTestId("slice-area")).toHaveText(`${(area / 1e6).toFixed(4)}\u00a0m²`);
  for (const format of ["GLB", "STL", "PLY", "DXF", "SVG"]) {
    const file = await request.get(await page.getByRole("link", { name: format }).getAttribute("href"));
    expect(file.ok(), format).toBe(true);
    expect((await file.body()).length, format).toBeGreaterThan(500);
  }
});

test("the legend names the limits of the boundary, and its fractions sum to one", async ({ page }) => {
  await open(page);
  const entries = page.locator(".legend li");
  await expect(entries.first()).toBeVisible();
  await expect(entries.filter({ hasText: "slider 1 at its lower end" })).toHaveCount(1);
  const shares = await entries.locator(".share").allTextContents();
  const sum = shares.reduce((sum, text) => sum + Number(text.replace(/[^\d.]/g, "")), 0);
  expect(sum).toBeGreaterThan(99);
  expect(sum).toBeLessThan(101);
});

test("a long computation shows its progress and can be cancelled", async ({ page, request }) => {
  await open(page);
  const machine = await verne(request);
  // Nine times the machine, meshed to a hundredth of a millimetre: minutes of work.
  for (const name of Object.keys(machine.geometry)) machine.geometry[name] *= 9;
  machine.name = "ninefold";
  machine.table = { da: 13500, dt: 1800 };
  machine.limits.stroke = [
    [0, 6750],
    [0, 6750],
    [0, 6750],
  ];
  await drop(page, "ninefold.json", JSON.stringify(machine));
  await expect(page.getByLabel("Machine", { exact: true })).toContainText("ninefold");
  const tolerance = page.getByLabel("Tolerance of the mesh");
  await tolerance.fill("0.01");
  await tolerance.press("Enter");
  const progress = page.getByTestId("progress");
  await expect(progress).toContainText("%");
  await progress.getByRole("button", { name: "Cancel" }).click();
  await expect(page.getByTestId("workspace-note")).toContainText("Cancelled.");
  await expect(page.getByTestId("progress")).toHaveCount(0);
  const { jobs } = await (await request.get("/jobs")).json();
  expect(jobs[0].state).toBe("cancelled");
  expect(jobs[0].machine.name).toBe("ninefold");

  // What is asked next is computed.
  await tolerance.fill("50");
  await tolerance.press("Enter");
  await expect(page.getByTestId("volume")).toBeVisible();
});

test("a row of the legend, and a face that is pointed at, isolates and names its limit", async ({ page }) => {
  await open(page);
  const canvas = page.locator("canvas");
  const row = page.locator(".legend").getByRole("button", { name: /^slider 1 at its lower end/ });
  await row.hover();
  await expect(canvas).toHaveAttribute("data-isolated", "stroke slider1.max");
  await row.click();
  await expect(row).toHaveAttribute("aria-pressed", "true");
  await page.getByRole("heading", { name: "Joints" }).hover();
  await expect(canvas).toHaveAttribute("data-isolated", "stroke slider1.max");
  await row.click();
  await page.getByRole("heading", { name: "Joints" }).hover();
  await expect(canvas).not.toHaveAttribute("data-isolated");

  const [x, y] = await pointOf(page, "tip");
  await page.mouse.move(x - 100, y + 30);
  const name = page.locator(".label.face");
  await expect(name).toBeVisible();
  const words = await name.textContent();
  await expect(page.locator(".legend button.pointed")).toContainText(words);
  await page.mouse.click(x - 100, y + 30);
  await expect(page.locator('.legend button[aria-pressed="true"]')).toContainText(words);
  // Beside the surface nothing is named.
  await page.mouse.click(x + 300, y + 150);
  await expect(page.locator('.legend button[aria-pressed="true"]')).toHaveCount(0);
});

test("the legend tells the cut face from the limits", async ({ page }) => {
  await open(page, "#section=300");
  await expect(page.getByText("cut face, no limit")).toBeVisible();
});
