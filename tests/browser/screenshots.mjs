// Pictures of the viewer, to be looked at: `npm run screenshots -- http://127.0.0.1:8080 out/ [name ...]`.
import { chromium } from "@playwright/test";
import { mkdir } from "node:fs/promises";
import { resolve } from "node:path";
import { LAUNCH } from "./launch.mjs";

const EXAMPLES = resolve(import.meta.dirname, "../../examples");

const [address = "http://127.0.0.1:8080", out = "../../target/screenshots", ...only] = process.argv.slice(2);

const DESK = { width: 1280, height: 720 };
const TABLET = { width: 1024, height: 768 };
const LARGE = { width: 1920, height: 1080 };
const PHONE = { width: 390, height: 844 };
const LANDSCAPE = { width: 844, height: 390 };
/** The desk at 200 % zoom. */
const ZOOMED = { width: 640, height: 360 };
const PICTURES = [
  ["home", DESK, "light", ""],
  ["home-dark", DESK, "dark", ""],
  ["tablet", TABLET, "light", "#workspace=tool&tool=100"],
  ["large", LARGE, "light", "#joints=398.764,561.144,589.474,-18.904,-30"],
  ["phone", PHONE, "light", ""],
  ["phone-dark", PHONE, "dark", ""],
  ["landscape", LANDSCAPE, "light", ""],
  ["zoomed", ZOOMED, "dark", ""],
  ["narrow", { width: 768, height: 1024 }, "dark", ""],
  ["assembly-modes", DESK, "light", "#joints=674,685,250,0,0&ghosts=assembly&workspace=hidden"],
  ["inverse-solutions", DESK, "dark", "#joints=287.718,4.604,94.242,0,0&ghosts=platform&workspace=hidden"],
  [
    "tilted-section",
    DESK,
    "light",
    "#joints=398.764,561.144,589.474,-18.904,-30&phi=20,30&section=300&solid=1",
  ],
  ["program", LARGE, "light", "#workspace=hidden&tool=100", "helix.ngc"],
  ["program-fails", DESK, "dark", "#workspace=hidden", "dome.cls"],
  ["program-phone", PHONE, "light", "#workspace=hidden", "dome.cls"],
  ["program-landscape", LANDSCAPE, "dark", "#workspace=hidden", "dome.cls"],
  ["broken-limit", DESK, "dark", "#joints=20,730,400,0,0&workspace=platform&section=1100"],
];

await mkdir(out, { recursive: true });
const browser = await chromium.launch(LAUNCH);
for (const [name, viewport, colorScheme, view, program] of PICTURES) {
  if (only.length > 0 && !only.includes(name)) continue;
  const page = await browser.newPage({ viewport, colorScheme });
  page.on("console", (message) => {
    if (message.type() === "error") console.error(`${name}: ${message.text()}`);
  });
  page.on("pageerror", (error) => console.error(`${name}: ${error}`));
  await page.goto(`${address}/${view}`);
  await page.locator("canvas[data-ready=yes]").waitFor();
  if (!view.includes("hidden")) await page.getByTestId("volume").waitFor();
  if (program) {
    await page.getByLabel("Open a program").setInputFiles(resolve(EXAMPLES, program));
    await page.getByTestId("verdict").waitFor();
    await page.getByRole("slider", { name: /^Time in the program/ }).press("PageUp");
    await page.getByRole("button", { name: "Look at the path" }).click();
  }
  await page.waitForLoadState("networkidle");
  await page.locator("canvas[data-picture=good]").waitFor();
  await page.screenshot({ path: `${out}/${name}.png` });
  await page.close();
}
await browser.close();
