// A family of workspaces: volume over tool length or phi1, as the service computes it.
import { expectAccessible, expectNothingOverflows, inEveryLook } from "./looks.mjs";
import { ask, expect, open, test, value } from "./viewer.mjs";

async function openFamily(page, view = "") {
  await open(page, view);
  await page.getByRole("heading", { name: "Volume over tool length or φ₁" }).click();
  await expect(page.getByRole("button", { name: "Compute the family" })).toBeVisible();
}

async function type(page, label, text) {
  const field = page.getByLabel(label, { exact: true });
  await field.fill(text);
  await field.press("Enter");
}

const volumes = (page) =>
  page.locator(".members data").evaluateAll((figures) => figures.map(({ value }) => Number(value)));

test("the volume over the tool length is that of the service; a click on a point shows its workspace", async ({
  page,
  request,
}) => {
  await openFamily(page, "#tolerance=5");
  await type(page, "First tool length, mm", "0");
  await type(page, "Last tool length, mm", "400");
  await type(page, "Workspaces", "5");
  await page.getByRole("button", { name: "Compute the family" }).click();
  await expect(page.locator(".members tbody tr")).toHaveCount(5);
  const settings = { kind: "part", phi1: 0, phi2: 0, table_clearance: 0, tolerance: 5 };
  const { members } = await ask(request, "/workspace", { ...settings, tool_length: [0, 100, 200, 300, 400] });
  expect(await volumes(page)).toEqual(members.map(({ volume }) => volume));

  const plot = page.locator(".family-plot .u-over");
  const { width, height } = await plot.boundingBox();
  await plot.click({ position: { x: 0.74 * width, y: height / 2 } });
  await expect(page.getByLabel("Tool length, typed, mm")).toHaveValue("300.0");
  await expect(page.getByRole("link", { name: "GLB" })).toHaveAttribute("href", new RegExp(members[3].id));
  expect(await value(page.getByTestId("volume"))).toBe(members[3].volume);
  await expect(page.getByTestId("caption")).toHaveText(/^Workspace on the part, tool 300\.0.mm/);
  // The family is still that of the page: its parameter is the only thing that has changed.
  await expect(page.getByTestId("family-caption")).toHaveText(/^Workspaces on the part, φ₁ 0\.0°, φ₂ 0\.0°$/);
});

test("the volume over phi1, by keyboard", async ({ page }) => {
  await openFamily(page, "#tolerance=5");
  await page.getByRole("radio", { name: "φ₁", exact: true }).focus();
  await page.keyboard.press("Space");
  await expect(page.getByLabel("First phi 1, degrees")).toHaveValue("-40.0");
  await type(page, "First phi 1, degrees", "20");
  await type(page, "Last phi 1, degrees", "-20");
  await type(page, "Workspaces", "3");
  await page.getByRole("button", { name: "Compute the family" }).press("Enter");
  const row = page.getByRole("button", { name: "Show the workspace for φ₁ 20.0°" });
  await row.press("Enter");
  await expect(row).toHaveAttribute("aria-pressed", "true");
  await expect(page).toHaveURL(/phi=20,0/);
  await expect(page.getByTestId("caption")).toHaveText(/φ₁ 20\.0°, φ₂ 0\.0°. The machine stands at φ₁ 0\.0°/);
  const shown = await volumes(page);
  expect(await value(page.getByTestId("volume"))).toBe(shown[2]);
  // Other settings are told.
  await type(page, "Tolerance of the mesh, mm", "8");
  await expect(page.getByTestId("family-caption")).toHaveText(/^Other settings than those of the page: /);
});

test("the link has the section with its settings, and without it the section is closed", async ({ page }) => {
  await openFamily(page);
  await page.getByRole("radio", { name: "φ₁", exact: true }).check({ force: true });
  await type(page, "Last phi 1, degrees", "12.5");
  await type(page, "Workspaces", "5");
  await expect(page).toHaveURL(/[#&]family=phi1,-40,12\.5,5$/);
  await page.reload();
  await expect(page.getByLabel("Last phi 1, degrees")).toHaveValue("12.5");
  await expect(page.getByLabel("Workspaces", { exact: true })).toHaveValue("5");
  await page.getByRole("heading", { name: "Volume over tool length or φ₁" }).click();
  await expect(page).not.toHaveURL(/family/);
  await page.evaluate(() => (location.hash = "#family=tool,10,90,3"));
  await expect(page.getByLabel("First tool length, mm")).toHaveValue("10.0");
});

test("kinds that depend on fewer parameters offer no others", async ({ page }) => {
  await openFamily(page, "#workspace=tool");
  await expect(page.getByText("the workspace of the tool tip depends on no angle")).toBeVisible();
  await page.getByRole("group", { name: "Positions of" }).getByLabel("platform").check({ force: true });
  await expect(page.getByText("depends neither on the tool length nor on φ₁")).toBeVisible();
  await expect(page.getByRole("button", { name: "Compute the family" })).toHaveCount(0);
});

test("equal ends are refused with the reason, and a long family can be cancelled", async ({ page, request }) => {
  await openFamily(page, "#tolerance=0.05");
  await type(page, "Last tool length, mm", "0");
  await expect(page.getByText("The first and the last value are equal")).toBeVisible();
  await expect(page.getByRole("button", { name: "Compute the family" })).toBeDisabled();
  await type(page, "Last tool length, mm", "317");
  await type(page, "Workspaces", "101");
  await page.getByRole("button", { name: "Compute the family" }).click();
  const family = page.locator(".family");
  await expect(family.locator(".progress")).toContainText("%");
  await family.getByRole("button", { name: "Cancel" }).click();
  await expect(family.getByText("Cancelled.")).toBeVisible();
  const { jobs } = await (await request.get("/jobs?limit=100")).json();
  expect(jobs.find(({ kind }) => kind === "family").state).toBe("cancelled");
});

test("a family has no accessibility violations, and nothing overflows", async ({ page }) => {
  await openFamily(page, "#tolerance=5");
  await page.getByRole("button", { name: "Compute the family" }).click();
  await expect(page.locator(".members tbody tr")).toHaveCount(13);
  await inEveryLook(page, "family", async () => {
    await page.getByTestId("family-plot").scrollIntoViewIfNeeded();
    await expectAccessible(page, ".family");
    await expectNothingOverflows(page, ".family");
  });
});
