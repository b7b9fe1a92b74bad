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
