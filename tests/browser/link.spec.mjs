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
});

test("the open page follows a pasted address", async ({ page }) => {
  await open(page);
  await page.evaluate(() => (location.hash = "#joints=300,310,320,0,0"));
  await expect(page.getByRole("slider", { name: "Slider 3, mm" })).toHaveValue("320");
});
