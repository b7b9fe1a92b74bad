// Opens the built page of examples/typescript in Chromium, beside a service (VERNE), and looks at the picture: it must
// have many colours, as the limits have in a workspace, on a background.
import { spawn } from "node:child_process";
import { once } from "node:events";
import { mkdir } from "node:fs/promises";
import { createRequire } from "node:module";
import { LAUNCH } from "../browser/launch.mjs";

const root = new URL("../..", import.meta.url).pathname;
const { chromium } = createRequire(`${root}tests/browser/`)("@playwright/test");
const { preview } = await import(createRequire(`${root}examples/typescript/`).resolve("vite"));
const SCREENSHOT = `${root}target/examples/workspace.png`;
const LEAST_COLOURS = 200;

const page_server = await preview({
  root: `${root}examples/typescript`,
  preview: { host: "127.0.0.1", port: 0, strictPort: false },
  logLevel: "error",
});
const origin = `http://127.0.0.1:${page_server.httpServer.address().port}`;

/** A service on a free port: its process, and its address, which the service writes to its log. */
async function serve() {
  const port = 20000 + Math.floor(Math.random() * 40000);
  const flags = ["serve", "--memory-only", "--listen", `127.0.0.1:${port}`, "--cors-origin", origin];
  const service = spawn(process.env.VERNE, flags, { stdio: "ignore" });
  const address = `http://127.0.0.1:${port}`;
  for (;;) {
    if (service.exitCode !== null) throw new Error("the service does not start");
    const ready = await fetch(`${address}/readyz`).catch(() => null);
    if (ready?.ok) return { service, address };
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
}

/** The number of different colours in a picture, counted by the browser. */
function colours(page, picture) {
  return page.evaluate(async (url) => {
    const image = await createImageBitmap(await (await fetch(url)).blob());
    const canvas = new OffscreenCanvas(image.width, image.height);
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, image.width, image.height);
    return new Set(new Uint32Array(data.buffer)).size;
  }, `data:image/png;base64,${picture.toString("base64")}`);
}

const { service, address } = await serve();
const browser = await chromium.launch(LAUNCH);
try {
  const page = await browser.newPage({ viewport: { width: 1000, height: 640 } });
  const errors = [];
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  page.on("pageerror", (error) => errors.push(String(error)));
  await page.goto(`${origin}/?server=${encodeURIComponent(address)}`);
  await page.locator("body[data-drawn=yes]").waitFor({ timeout: 120_000 });
  const volume = await page.getByRole("status").textContent();
  await mkdir(new URL(".", `file://${SCREENSHOT}`), { recursive: true });
  const picture = await page.screenshot({ path: SCREENSHOT });
  const count = await colours(page, picture);
  console.log(`the page shows ${volume} in ${count} colours: ${SCREENSHOT}`);
  if (errors.length > 0) throw new Error(`errors on the console: ${errors.join("; ")}`);
  if (!/^0\.3004 m³$/.test(volume)) throw new Error("the volume is another one");
  if (count < LEAST_COLOURS) throw new Error(`the picture has ${count} colours only`);
} finally {
  await browser.close();
  service.kill();
  await once(service, "exit");
  await page_server.close();
}
