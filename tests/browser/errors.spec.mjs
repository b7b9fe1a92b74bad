// The errors of the tool over a workspace: ranges as the service computes them, bands in the scene, and the link.
import { expectAccessible, expectNothingOverflows, inEveryLook } from "./looks.mjs";
import { ask, expect, open, test } from "./viewer.mjs";

const HEADING = "Errors of the tool";
const range = (page) => page.getByTestId("errors-range");

async function openErrors(page, view = "") {
  await open(page, view);
  await page.getByRole("heading", { name: HEADING }).click();
  await expect(page.getByRole("button", { name: "Compute the errors" })).toBeEnabled();
}

async function type(page, label, text) {
  const field = page.getByLabel(label);
  await field.fill(text);
  await field.press("Enter");
}

test("ranges are those of the service, and the scene has the bands of the error that is chosen", async ({
  page,
  request,
}) => {
  await openErrors(page, "#workspace=tool");
  await type(page, "Tolerance of the lengths of the rods, mm", "0.05");
  await type(page, "Tolerance of the places of the joints", "0");
  await type(page, "Tolerance of the places of the sliders, mm", "0");
  await page.getByRole("button", { name: "Compute the errors" }).click();
  const body = {
    kind: "tool",
    tool_length: 50,
    cell: 50,
    tolerance: 10,
    parameter_tolerances: { L1: 0.05, L2: 0.05, L3: 0.05 },
  };
  await expect(range(page)).toBeVisible();
  const { errors, id } = await ask(request, "/workspace/error-budget", body);
  const { least, largest } = errors.tip_worst;
  await expect(range(page)).toHaveText(`${least.toFixed(4)} mm to ${largest.toFixed(4)} mm`);
  const canvas = page.locator("canvas[data-ready=yes]");
  const bands = page.locator(".errors ul li");
  await expect(bands).toHaveCount(10);
  await expect(canvas).not.toHaveAttribute("data-bands", "0");
  await expect(bands.first()).toHaveText(/mm$/);

  await page.getByLabel("Error", { exact: true }).selectOption("angle, rms");
  await expect(range(page)).toHaveText(new RegExp(`^${errors.axis_rms.least.toFixed(5)}° to`));
  await expect(bands.first()).toHaveText(/°$/);
  const mesh = await (await request.get(`/workspace/${id}/mesh.json?error=axis_rms`)).json();
  const [, from, to] = /([\d.]+) to ([\d.]+) deg/.exec(mesh.palette.at(-1).name);
  await expect(bands.first()).toHaveText(`${from} to ${to}°`);
  await page.getByLabel("show the surface").uncheck();
  await expect(canvas).toHaveAttribute("data-bands", "0");

  // Other settings are told.
  await type(page, "Tool length, typed, mm", "80");
  await expect(page.getByTestId("errors-caption")).toHaveText(/^Other settings than those of the page: /);
});

test("the link has the section with its tolerances, and nothing is computed without one", async ({ page }) => {
  await open(page, "#workspace=hidden&errors=0,0,0,0,0.004");
  await expect(page.getByLabel("Tolerance of the directions and angles", { exact: false })).toHaveValue("0.004");
  await expect(page.getByRole("button", { name: "Compute the errors" })).toBeEnabled();
  await type(page, "Tolerance of the directions and angles", "0");
  await expect(page.getByRole("button", { name: "Compute the errors" })).toBeDisabled();
  await expect(page).toHaveURL(/errors=0,0,0,0,0/);
  await page.getByRole("heading", { name: HEADING }).click();
  await expect(page).not.toHaveURL(/errors/);
});

test("the errors have no accessibility violations, and nothing overflows", async ({ page }) => {
  await openErrors(page);
  await page.getByRole("button", { name: "Compute the errors" }).click();
  await expect(page.locator(".errors ul li")).toHaveCount(10);
  await inEveryLook(page, "errors", async () => {
    await page.locator(".errors ul").scrollIntoViewIfNeeded();
    await expectAccessible(page, ".errors");
    await expectNothingOverflows(page, ".errors");
  });
});
