// A service with keys: the page asks for one, and everything goes with it.
import { spawn, spawnSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { expect, test } from "./viewer.mjs";

const ADDRESS = "127.0.0.1:18474";
const VERNE = resolve(import.meta.dirname, process.env.VERNE ?? "../../target/debug/verne");

let directory, service, key;

test.beforeAll(async () => {
  const made = spawnSync(VERNE, ["key", "new", "--name", "cam", "--role", "compute"], { encoding: "utf8" });
  key = made.stderr.trim();
  directory = mkdtempSync(join(tmpdir(), "verne-keys-"));
  const file = join(directory, "keys.toml");
  writeFileSync(file, made.stdout);
  service = spawn(VERNE, ["serve", "--memory-only", "--wait", "0", "--listen", ADDRESS, "--keys", file]);
  const ready = () => fetch(`http://${ADDRESS}/readyz`).then(({ ok }) => ok, () => false);
  await expect.poll(ready).toBe(true);
});

test.afterAll(() => {
  service.kill();
  rmSync(directory, { recursive: true });
});

test.use({ baseURL: `http://${ADDRESS}`, provoked: [/status of 401/] });

test("the viewer asks for a key and uses it for machines, jobs, meshes and files", async ({ page }) => {
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

test("without a key the page says why it is empty, and asks again", async ({ page }) => {
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
