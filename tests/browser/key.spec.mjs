// A service with keys: the page asks for one, and everything goes with it.
import { spawnSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { serve, VERNE } from "./service.mjs";
import { expect, test as base } from "./viewer.mjs";

const test = base.extend({
  // A service with one key, beside the worker's own.
  keyed: [
    async ({}, use) => {
      const made = spawnSync(VERNE, ["key", "new", "--name", "cam", "--role", "compute"], { encoding: "utf8" });
      const directory = mkdtempSync(join(tmpdir(), "verne-keys-"));
      const file = join(directory, "keys.toml");
      writeFileSync(file, made.stdout);
      const { address, stop } = await serve("--wait", "0", "--keys", file);
      await use({ address, key: made.stderr.trim() });
      stop();
      rmSync(directory, { recursive: true });
    },
    { scope: "worker" },
  ],
  baseURL: async ({ keyed }, use) => use(keyed.address),
});

test.use({ provoked: [/status of 401/] });

test("the viewer asks for a key and uses it for machines, jobs, meshes and files", async ({ page, keyed: { key } }) => {
  await page.goto("/#workspace=tool&section=1200");
  const dialog = page.getByRole("dialog", { name: "This service asks for a key" });
  await dialog.getByLabel("Key").fill("wrong");
  await dialog.getByRole("button", { name: "Go on" }).click();
  await expect(dialog.getByRole("alert")).toBeVisible();
  await dialog.getByLabel("Key").fill(key);
  await dialog.getByLabel("Key").press("Enter");
  await expect(dialog).toBeHidden();
  await page.locator("canvas[data-ready=yes]").waitFor();
  await expect(page.locator(".legend li").first()).toBeVisible();
  await expect(page.getByTestId("slice-area")).toBeVisible();
  const download = page.waitForEvent("download");
  await page.getByRole("link", { name: "STL" }).click();
  expect((await download).suggestedFilename()).toBe("verne-tool.stl");
  // The tab keeps it.
  await page.reload();
  await page.locator("canvas[data-ready=yes]").waitFor();
  await expect(dialog).toBeHidden();
});

test("without a key the page says why it is empty, and asks again", async ({ page, keyed: { key } }) => {
  await page.goto("/");
  const dialog = page.getByRole("dialog", { name: "This service asks for a key" });
  await dialog.getByRole("button", { name: "Cancel" }).click();
  await expect(dialog).toBeHidden();
  await expect(page.getByRole("alert")).toContainText("This service answers only with a key.");
  await page.getByRole("button", { name: "Enter a key" }).click();
  await dialog.getByLabel("Key").fill(key);
  await dialog.getByLabel("Key").press("Enter");
  await page.locator("canvas[data-ready=yes]").waitFor();
  await expect(page.getByRole("alert")).toHaveCount(0);
  await expect(page.getByLabel("Machine", { exact: true })).toHaveValue("verne");
});
