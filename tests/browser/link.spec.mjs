// The address is the view.
import { expect, figure, open, test } from "./viewer.mjs";

test("a deep link shows the pose and settings that it contains", async ({ page }) => {
  await open(page, "#joints=674,685,250,-20,35&tool=80&ghosts=assembly&workspace=tool&section=1250&solid=1");
  await expect(page.getByRole("slider", { name: "Table tilt, degrees" })).toHaveValue("-20");
  await expect(figure(page, "Platform tilt")).toHaveText("−22.44°");
  await expect(page.getByTestId("ghost-count")).toHaveText("4");
  await expect(page.getByRole("radio", { name: "tool tip" })).toBeChecked();
  await expect(page.getByLabel("solid")).toBeChecked();
  await expect(page.getByTestId("slice-area")).toHaveText(/m²$/);
  await expect(page.getByTestId("notice")).toHaveCount(0);
});

test("the open page follows a pasted address", async ({ page }) => {
  await open(page);
  await page.evaluate(() => (location.hash = "#joints=300,310,320,0,0"));
  await expect(page.getByRole("slider", { name: "Slider 3, mm" })).toHaveValue("320");
});

test.describe("a link that cannot be shown leads home, and a notice says what it asked for", () => {
  test.use({ provoked: [/status of 4(04|22)/] });

  for (const [name, link, words] of [
    ["joints that no posture has", "joints=99999,0,0,0,0", /Its joints are 99999, 0, 0, 0, 0\..* stands at home/],
    ["joints far outside", "joints=5000,5000,5000,0,0", /Slider 1 would be far outside of the machine\./],
    ["an unknown machine", "machine=nosuch&joints=1,2,3,0,0", /machine “nosuch” is not available: .* built-in machine/],
    ["a broken machine", "own=q1ZKzE0FAA", /“own=q1ZKzE0FAA”, which cannot be read/],
    ["words in place of numbers", "joints=a,b&tool=-4", /“joints=a,b”, “tool=-4”, which cannot be read/],
    ["impossible settings of sections", "family=tool,0&dexterity=0,9,1", /“family=tool,0”, “dexterity=0,9,1”, which/],
    ["an impossible tool", "tool=1e9", /Its tool cannot be used: .*home with a tool of 50.mm/],
    ["a camera that looks elsewhere", "camera=900,0,0,800,0,0", /Its camera does not see the machine/],
  ]) {
    test(name, async ({ page }) => {
      await open(page, `#${link}`);
      await expect(page.getByTestId("notice")).toHaveText(words);
      await expect(page.getByLabel("Machine", { exact: true })).toHaveValue("verne");
      await expect(figure(page, "Platform tilt")).toHaveText("0.00°");
      await expect(page.getByTestId("volume")).toBeVisible();
      await page.getByRole("button", { name: "Dismiss" }).click();
      await expect(page.getByTestId("notice")).toHaveCount(0);
    });
  }
});
