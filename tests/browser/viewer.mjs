// What every test of the viewer starts from: a page whose console stays clean.
import { test as base, expect } from "@playwright/test";
import { serve } from "./service.mjs";

export { expect };

export const test = base.extend({
  // Messages that a test provokes on purpose, such as the browser's own note of a refused request.
  provoked: [[], { option: true }],
  // Each worker has a service of its own: its tests find no jobs of others. VERNE_ADDRESS is one that runs already.
  service: [
    async ({}, use) => {
      const running = process.env.VERNE_ADDRESS;
      const { address, stop } = running ? { address: running, stop: () => {} } : await serve();
      await use(address);
      stop();
    },
    { scope: "worker" },
  ],
  baseURL: async ({ service }, use) => use(service),
  page: async ({ page, provoked }, use) => {
    const errors = [];
    page.on("console", (message) => {
      if (message.type() === "error" && !provoked.some((known) => known.test(message.text())))
        errors.push(message.text());
    });
    page.on("pageerror", (error) => errors.push(String(error)));
    await use(page);
    expect(errors, "errors on the console").toEqual([]);
  },
});

/** Opens a view and waits for the machine to stand there. */
export async function open(page, view = "") {
  await page.goto(`/${view}`);
  await page.locator("canvas[data-ready=yes]").waitFor();
}

/** Waits until what has changed is laid out and drawn: two frames, in the first of which watchers of sizes are told. */
export async function drawn(page) {
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
}

/** A figure of the page that carries its full value. */
export async function value(locator) {
  return Number(await locator.getAttribute("value"));
}

/** The text beside a term of a list of figures. */
export function figure(page, term) {
  return page.locator("dt", { hasText: term }).locator("xpath=following-sibling::dd[1]");
}

/** Asks the service itself. */
export async function ask(request, path, body) {
  const response = await request.post(path, { data: body });
  expect(response.ok(), await response.text()).toBe(true);
  return response.json();
}

/** Drops a file on the page as a hand does. */
export async function drop(page, name, content) {
  const transfer = await page.evaluateHandle(
    ([name, content]) => {
      const transfer = new DataTransfer();
      transfer.items.add(new File([content], name, { type: "application/json" }));
      return transfer;
    },
    [name, content],
  );
  await page.dispatchEvent("body", "dragover", { dataTransfer: transfer });
  await page.dispatchEvent("body", "drop", { dataTransfer: transfer });
}

/** The built-in machine's definition, to be changed. */
export async function verne(request) {
  return (await (await request.get("/machines/verne")).json()).definition;
}

/** A value of the canvas's data, `u,v` from -1 to 1 both ways, as a point of the page. */
export async function pointOf(page, name) {
  const canvas = page.locator("canvas");
  const { x, y, width, height } = await canvas.boundingBox();
  const [u, v] = (await canvas.getAttribute(`data-${name}`)).split(",").map(Number);
  return [x + ((u + 1) / 2) * width, y + ((1 - v) / 2) * height];
}
