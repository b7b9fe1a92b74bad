// Machines of one's own.
import { drop, expect, open, test, value, verne } from "./viewer.mjs";

test.describe("a broken machine file", () => {
  test.use({ provoked: [/status of 422/] });

  test("is refused with errors at the fields, and the machine does not change", async ({ page, request }) => {
    await open(page);
    const machine = await verne(request);
    machine.geometry.L1 = -5;
    machine.limits.stroke[1] = [700, 100];
    await drop(page, "broken.json", JSON.stringify(machine));
    const dialog = page.getByRole("dialog", { name: "broken.json makes no machine" });
    await expect(dialog.getByRole("row", { name: /geometry › L1/ })).toContainText("positive length");
    await expect(dialog.getByRole("row", { name: /limits › stroke › 1/ })).toContainText("min < max");
    await expect(dialog.locator("tr.bad")).toHaveCount(2);
    await page.keyboard.press("Escape");
    await expect(dialog).toBeHidden();
    await expect(page.getByLabel("Machine", { exact: true })).toHaveValue("verne");
  });
});

test("a file that is not JSON is refused", async ({ page }) => {
  await open(page);
  await drop(page, "notes.json", "rods: 6");
  await expect(page.getByRole("dialog", { name: "notes.json makes no machine" })).toContainText("not JSON");
});

test("a valid file becomes the machine, and the link contains it", async ({ page, request, browser }) => {
  await open(page);
  const volume = page.getByTestId("volume");
  await expect(volume).toBeVisible();
  const machine = await verne(request);
  machine.name = "short stroke";
  machine.limits.stroke = [
    [0, 400],
    [0, 400],
    [0, 400],
  ];
  await drop(page, "short.json", JSON.stringify(machine));
  await expect(page.getByLabel("Machine", { exact: true })).toContainText("short stroke (own file)");
  const answer = await request.post("/workspace", { data: { machine, kind: "part", tool_length: 50, table_clearance: 0 } });
  const asked = await answer.json();
  await expect(page.getByRole("link", { name: "GLB" })).toHaveAttribute("href", new RegExp(asked.id));
  expect(await value(volume)).toBe(asked.volume);
  await expect(page).toHaveURL(/own=/);

  const colleague = await browser.newPage();
  await colleague.goto(page.url());
  await expect(colleague.getByLabel("Machine", { exact: true })).toContainText("short stroke (own file)");
  await expect(colleague.getByTestId("volume")).toHaveAttribute("value", String(asked.volume));
  await colleague.close();
});

test("a file's faults of types are all reported at their fields, in words", async ({ page, request }) => {
  await open(page);
  const machine = await verne(request);
  machine.geometry.L1 = "long";
  machine.table.da = true;
  machine.limits.stroke[2] = [0];
  delete machine.geometry.R1;
  machine.geometry.R9 = 3;
  await drop(page, "types.json", JSON.stringify(machine));
  const dialog = page.getByRole("dialog", { name: "types.json makes no machine" });
  await expect(dialog.getByRole("row", { name: /geometry › L1/ })).toContainText("must be a number, not a text");
  await expect(dialog.getByRole("row", { name: /table › da/ })).toContainText("must be a number, not true or false");
  await expect(dialog.getByRole("row", { name: /limits › stroke › 2/ })).toContainText("must have 2 entries, not 1");
  await expect(dialog.getByRole("row", { name: /geometry › R9/ })).toContainText("is no field of a machine");
  await expect(dialog).toContainText("/geometry/R1 is missing");
});

test("the machine is downloaded as the JSON that the page takes", async ({ page, request }) => {
  await open(page);
  const download = page.waitForEvent("download");
  await page.getByRole("button", { name: "Download JSON" }).click();
  const file = await download;
  expect(file.suggestedFilename()).toBe("verne.json");
  const { readFileSync } = await import("node:fs");
  expect(JSON.parse(readFileSync(await file.path(), "utf8"))).toEqual(await verne(request));
});

test.describe("dimensions", () => {
  test.use({ provoked: [/status of 422/] });

  test("are changed in a form, and the machine changes; what is refused stays at its field", async ({ page, request }) => {
    await open(page);
    await expect(page.getByTestId("volume")).toBeVisible();
    await page.getByText("Change them").click();
    const form = page.getByRole("region", { name: "Dimensions and limits" });
    const typed = async (label, value) => {
      await form.getByLabel(label, { exact: true }).fill(String(value));
      await form.getByLabel(label, { exact: true }).press("Enter");
    };
    await typed("stroke 1 max", 600);
    await expect(page.getByLabel("Machine", { exact: true })).toContainText("verne, changed (own file)");
    await expect(page.getByRole("slider", { name: "Slider 1, mm" })).toHaveAttribute("max", "600");
    const machine = await verne(request);
    Object.assign(machine, { name: "verne, changed", description: "Changed on the page." });
    machine.limits.stroke[0] = [0, 600];
    const answer = await request.post("/workspace", {
      data: { machine, kind: "part", tool_length: 50, table_clearance: 0 },
    });
    await expect(page.getByRole("link", { name: "GLB" })).toHaveAttribute("href", new RegExp((await answer.json()).id));

    // Within the schema, but the stroke would be empty.
    await typed("stroke 2 min", 800);
    await expect(form.getByRole("alert")).toContainText(/stroke 2.*min < max/);
    await expect(form.getByLabel("stroke 2 min", { exact: true })).toHaveValue("800");
    await form.getByRole("button", { name: "Discard" }).click();
    await expect(form.getByLabel("stroke 2 min", { exact: true })).toHaveValue("0");
    // Beyond the schema.
    await typed("L1", 1e9);
    await expect(form.getByRole("alert")).toContainText("from 0.001 to 1000000");

    await page.getByRole("button", { name: "Undo" }).click();
    await expect(page.getByLabel("Machine", { exact: true })).toHaveValue("verne");
  });
});
