// What the viewer weighs and how fast it is: `npm run measure -- http://127.0.0.1:8080`, against a release build.
import { chromium } from "@playwright/test";
import { brotliCompressSync } from "node:zlib";
import { bundle } from "./bundle.mjs";
import { LAUNCH } from "./launch.mjs";

const [address = "http://127.0.0.1:8080"] = process.argv.slice(2);

const DRAG_MS = 4000;
const TOLERANCES = [1, 0.037];

const total = { first: [0, 0], later: [0, 0] };
for (const { first, body } of await bundle(address)) {
  const sum = total[first ? "first" : "later"];
  sum[0] += body.length;
  sum[1] += brotliCompressSync(body).length;
}
const kilobytes = ([plain, compressed]) => `${(plain / 1000).toFixed(0)} kB (brotli: ${(compressed / 1000).toFixed(0)} kB)`;
console.log(`bundle: ${kilobytes(total.first)} for the first picture, ${kilobytes(total.later)} for what is opened later`);

const browser = await chromium.launch(LAUNCH);
const context = await browser.newContext({ viewport: { width: 1280, height: 720 } });
// Notes when the first pictures with the machine, and with the workspace's surface, were drawn.
await context.addInitScript(() => {
  const look = () => {
    if (document.querySelector("canvas[data-ready=yes]")) window.machineSeen ??= performance.now();
    if (document.querySelector(".legend li")) window.workspaceSeen ??= performance.now();
    if (window.machineSeen === undefined || window.workspaceSeen === undefined) requestAnimationFrame(look);
  };
  requestAnimationFrame(look);
});
const page = await context.newPage();
for (const run of ["cold", "warm", "warm", "warm"]) {
  await page.goto(`${address}/`);
  await page.waitForFunction(() => window.machineSeen !== undefined && window.workspaceSeen !== undefined);
  const [machine, workspace] = await page.evaluate(() => [window.machineSeen, window.workspaceSeen]);
  console.log(
    `first picture, ${run}: machine ${machine.toFixed(0)} ms, workspace ${workspace.toFixed(0)} ms`,
  );
}

for (const tolerance of TOLERANCES) {
  await page.goto("about:blank");
  await page.goto(`${address}/#tolerance=${tolerance}`);
  await page.locator(".legend li").first().waitFor();
  const triangles = await page
    .locator("dt", { hasText: "Mesh" })
    .locator("xpath=following-sibling::dd[1]")
    .textContent();
  console.log(
    `${triangles}: turning ${await pictures(turn)}, a slider dragged ${await pictures(slide)} pictures a second`,
  );
}
await browser.close();

/** Pictures a second while the hand, pressed down by `grip`, moves along the path that it answers. */
async function pictures(grip) {
  const count = () => page.evaluate(() => Number(document.querySelector("canvas").dataset.pictures));
  const at = await grip();
  const [from, began] = [await count(), performance.now()];
  const until = began + DRAG_MS;
  let step = 0;
  while (performance.now() < until) await page.mouse.move(...at(step++));
  const rate = ((await count()) - from) / ((performance.now() - began) / 1000);
  await page.mouse.up();
  return rate.toFixed(1);
}

async function turn() {
  const { x, y, width, height } = await page.locator("canvas").boundingBox();
  const [u, v] = [x + width * 0.2, y + height * 0.85];
  await page.mouse.move(u, v);
  await page.mouse.down();
  return (step) => [u + 60 * Math.sin(step / 20), v + 10 * Math.cos(step / 20)];
}

async function slide() {
  const { x, y, width, height } = await page.getByRole("slider", { name: "Slider 1, mm" }).boundingBox();
  const v = y + height / 2;
  await page.mouse.move(x + width * 0.45, v);
  await page.mouse.down();
  return (step) => [x + width * (0.45 + 0.08 * Math.sin(step / 15)), v];
}
