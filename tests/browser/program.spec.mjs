// Programs: opened, shown, played, corrected and saved.
import { readFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { drawn, drop, expect, open, test } from "./viewer.mjs";

const EXAMPLES = resolve(import.meta.dirname, "../../examples");
const DOME = readFileSync(join(EXAMPLES, "dome.cls"), "utf8");
const HELIX = readFileSync(join(EXAMPLES, "helix.ngc"), "utf8");
/** Its third move leaves the reach of the machine. */
const TOO_FAR = "UNITS/MM\nRAPID\nGOTO/0,0,320\nFEDRAT/1000,MMPM\nGOTO/0,0,300\nGOTO/650,0,300\nGOTO/0,0,300\n";

/** All of it is out of reach, and within reach elsewhere on the table. */
const ASIDE = "UNITS/MM\nRAPID\nGOTO/480,0,320\nFEDRAT/1000,MMPM\nGOTO/480,0,300\nGOTO/520,0,300\n";

const time = (page) => page.getByRole("slider", { name: "Time in the program, seconds" });
const where = (page) => page.getByTestId("where");
const verdict = (page) => page.getByTestId("verdict");
const currentLine = (page) => page.locator('.text-list [aria-selected="true"]');
const press = (page, name) => page.getByRole("button", { name, exact: true }).click();

/** Opens the page and drops a program on it. */
async function program(page, name, text, view = "#workspace=hidden&tool=100") {
  await open(page, view);
  await drop(page, name, text);
  await expect(verdict(page)).toBeVisible();
}

test("a helix is played to its end, and stands where the program says", async ({ page }) => {
  await program(page, "helix.ngc", HELIX);
  await expect(verdict(page)).toContainText("The machine can run the program.");
  await expect(page.getByTestId("moves")).toHaveText("139");
  await page.getByLabel("Speed").selectOption("20");
  await press(page, "Play");
  await expect(page.getByRole("button", { name: "Pause", exact: true })).toBeVisible();
  // It stops by itself at the end of line 147: Y-65.778 Z220.
  await expect(page.getByRole("button", { name: "Play", exact: true })).toBeVisible();
  await expect(where(page)).toContainText("line 146");
  await expect(page.getByLabel("X on the part, mm")).toHaveValue("-23.9");
  await expect(page.getByLabel("Z above the table, mm")).toHaveValue("220.0");
  await expect(currentLine(page)).toContainText("G0 X-23.941");
});

test("it is stepped and moved by keyboard, from the time and from the text", async ({ page }) => {
  await program(page, "helix.ngc", HELIX);
  await time(page).focus();
  await page.keyboard.press("ArrowRight");
  await expect(where(page)).toContainText("row 2 of");
  await page.keyboard.press("ArrowLeft");
  await expect(where(page)).toContainText("row 1 of");
  await page.keyboard.press("End");
  await expect(where(page)).toContainText("line 146");
  await page.keyboard.press("Home");
  await page.keyboard.press("Space");
  await expect(page.getByRole("button", { name: "Pause", exact: true })).toBeVisible();
  await page.keyboard.press("Space");
  await expect(page.getByRole("button", { name: "Play", exact: true })).toBeVisible();
  const text = page.getByRole("listbox", { name: "Program text" });
  await text.focus();
  await page.keyboard.press("Home");
  await expect(where(page)).toContainText("line 8");
  await page.keyboard.press("ArrowDown");
  await expect(where(page)).toContainText("line 9");
  await page.keyboard.press("PageDown");
  await expect(where(page)).not.toContainText("line 9");
  await text.getByRole("option").first().click();
  await expect(page.getByLabel("X on the part, mm")).not.toHaveValue("0.0");
});

test("a loop begins anew", async ({ page }) => {
  await program(page, "helix.ngc", HELIX);
  await page.getByLabel("loop").check();
  await page.getByLabel("Speed").selectOption("100");
  await time(page).press("End");
  await press(page, "One row back");
  await expect(where(page)).toContainText("row 411 of 412");
  await press(page, "Play");
  await expect(where(page)).not.toContainText("row 41");
  await press(page, "Pause");
});

test("a failing line of the dome is found in the list, and the proposed change heals it", async ({ page }) => {
  await program(page, "dome.cls", DOME);
  await expect(verdict(page)).toContainText("The machine cannot run the program");
  await expect(page.getByText("12 stretches fail")).toBeVisible();
  await press(page, "lines 22 to 31: platform joint 11 would be 28.2\u00a0mm too low over the table");
  await expect(where(page)).toContainText("line 23");
  await expect(page.getByTestId("margins").getByRole("listitem").first()).toContainText(
    /platform joint 11 28\.2.mm too low over the table/,
  );
  await expect(currentLine(page)).toContainText("GOTO/90.0000,-90.0000,54.2725");
  await page.getByRole("button", { name: /^move the set-up by \+28\.2.mm in Z$/ }).first().click();
  await expect(verdict(page)).toContainText("The machine can run the program.");
  await expect(page.getByLabel("Set-up: z, mm")).toHaveValue("28.188");
  await expect(page.getByText("stretches fail")).toHaveCount(0);
  // A change that does not please is undone.
  await press(page, "Undo");
  await expect(page.getByText("12 stretches fail")).toBeVisible();
  await press(page, "Redo");
  await expect(verdict(page)).toContainText("The machine can run the program.");
});

test("where the table cannot turn on, the tool retracts", async ({ page }) => {
  const turns = Array.from({ length: 109 }, (_, i) => `[${60 * Math.cos(i / 6)},${60 * Math.sin(i / 6)},300,20,${(i / 6 / Math.PI) * 180}]`);
  await program(page, "turns.ndjson", turns.join("\n"));
  await expect(page.getByRole("button", { name: /the table would turn .*° too far$/ }).first()).toBeVisible();
  await page.getByRole("button", { name: "retract there and turn the table back" }).first().click();
  await expect(verdict(page)).toContainText("The machine can run the program.");
});

test("text and plots can be put away, and the program closed", async ({ page }) => {
  await program(page, "helix.ngc", HELIX);
  const text = page.getByRole("listbox", { name: "Program text" });
  await press(page, "Text and plots");
  await expect(text).toBeHidden();
  await press(page, "Text and plots");
  await expect(text).toBeVisible();
  await press(page, "Close");
  await expect(where(page)).toHaveCount(0);
  await expect(page).not.toHaveURL(/program=/);
});

test("a place out of reach is named, and the machine stands at the last place before it", async ({ page }) => {
  await program(page, "far.cls", TOO_FAR);
  await page.getByRole("button", { name: /^lines? 6.* leg 1 would be too short by/ }).first().click();
  await expect(page.getByTestId("trouble")).toHaveText(/^Out of reach: leg 1 too short by/);
  await expect(where(page)).toContainText("line 5");
  await press(page, "Next failing stretch");
  await expect(where(page)).toContainText("line 5");
});

test("a click on a plot and on the path moves the machine there", async ({ page }) => {
  // The table stands still: a place of the path stays where it is seen.
  await program(page, "line.cls", "UNITS/MM\nFEDRAT/600,MMPM\nGOTO/-100,0,300\nGOTO/100,0,300\n");
  const plot = page.getByRole("img", { name: /^Joints over time/ }).locator(".u-over");
  const { width, height } = await plot.boundingBox();
  await plot.click({ position: { x: 0.7 * width, y: height / 2 } });
  await expect(where(page)).toContainText(/0:1[34]\.\d of 0:20\.0/);
  const x = async () => Number(await page.getByLabel("X on the part, mm").inputValue());
  await expect.poll(async () => Math.abs((await x()) - 40)).toBeLessThan(10);
  await drawn(page);
  await page.locator("canvas[data-picture=good]").waitFor();
  const tip = await page.evaluate(() => document.querySelector("canvas").dataset.tip);
  await time(page).press("Home");
  await expect(page.getByLabel("X on the part, mm")).toHaveValue("-100.0");
  const scene = await page.locator(".scene canvas").boundingBox();
  const [u, v] = tip.split(",").map(Number);
  await page.mouse.click(scene.x + ((u + 1) / 2) * scene.width, scene.y + ((1 - v) / 2) * scene.height);
  await expect(where(page)).not.toContainText("row 1 of");
  // Within two rows of where the plot led: the pixels of a click are some millimetres wide.
  await expect.poll(async () => Math.abs((await x()) - 40)).toBeLessThan(25);
});

test("set-up, tool length and tolerance are planned anew", async ({ page }) => {
  await program(page, "helix.ngc", HELIX);
  const rows = page.locator("dt", { hasText: "Joint rows" }).locator("xpath=following-sibling::dd[1]");
  await expect(rows).toHaveText("412");
  await page.getByText("Tolerances and motion").click();
  const tip = page.getByLabel("Greatest deviation of the tool’s end, mm");
  await tip.fill("1");
  await tip.press("Enter");
  await expect(rows).not.toHaveText("412");
  const length = page.getByLabel("Length of every tool, mm");
  await length.fill("700");
  await length.press("Enter");
  await expect(verdict(page)).toContainText("cannot run");
  await length.fill("100");
  await length.press("Enter");
  await expect(verdict(page)).toContainText("can run");
  const x = page.getByLabel("Set-up: x, mm");
  await x.fill("40");
  await x.press("Enter");
  await time(page).press("End");
  await expect(page.getByLabel("X on the part, mm")).toHaveValue("16.1");
});

test("the joint program, the rows, the report and the path are saved", async ({ page }) => {
  await program(page, "helix.ngc", HELIX);
  for (const [link, name, begin] of [
    ["G-code", /\.ngc$/, /^[%(G]/],
    ["CSV", /\.csv$/, /^line,kind,x/],
    ["Report", /\.json$/, /"verdict":"ok"/],
    ["Path (GLB)", /\.glb$/, /^glTF/],
  ]) {
    const saved = page.waitForEvent("download");
    await page.getByRole("link", { name: link, exact: true }).click();
    const file = await saved;
    expect(file.suggestedFilename()).toMatch(name);
    expect(readFileSync(await file.path(), "latin1")).toMatch(begin);
  }
});

test.describe("a file with faults", () => {
  test.use({ provoked: [/status of 422/] });

  test("is refused with line, text and reason", async ({ page }) => {
    await open(page);
    await drop(page, "part.cls", "UNITS/MM\nGOTO/0,0,320\nGOTO/0,0\n");
    const dialog = page.getByRole("dialog", { name: "The service cannot read part.cls" });
    await expect(dialog.getByRole("listitem")).toContainText(["line 3"]);
    await expect(dialog.locator("code")).toHaveText("GOTO/0,0");
    await expect(dialog).toContainText("3 or 6 numbers");
    await page.keyboard.press("Escape");
    await expect(dialog).toBeHidden();
    await expect(where(page)).toHaveCount(0);
  });

  test("is read after the unit is stated", async ({ page }) => {
    await open(page);
    await drop(page, "part.cls", "GOTO/0,0,12\nFEDRAT/10,IPM\nGOTO/0,0,11.5\n");
    const dialog = page.getByRole("dialog");
    await dialog.getByRole("radio", { name: "inch", exact: true }).check();
    await dialog.getByRole("button", { name: "Read it again" }).click();
    await expect(verdict(page)).toBeVisible();
    await time(page).press("End");
    await expect(page.getByLabel("Z above the table, mm")).toHaveValue("292.1");
  });
});

test("a file of unknown kind is asked for its format", async ({ page }) => {
  await open(page);
  await drop(page, "part.txt", "UNITS/MM\nGOTO/0,0,320\nGOTO/0,0,300\n");
  const dialog = page.getByRole("dialog", { name: "What is part.txt?" });
  await dialog.getByLabel("Format of the file").selectOption("CL text (APT)");
  await dialog.getByRole("button", { name: "Open" }).click();
  await expect(verdict(page)).toBeVisible();
});

test("a link shows the program and its set-up", async ({ page, browser }) => {
  await program(page, "far.cls", ASIDE);
  await page.getByRole("button", { name: /^move the set-up by/ }).first().click();
  await expect(verdict(page)).toContainText("can run");
  const x = await page.getByLabel("Set-up: x, mm").inputValue();
  await expect(page).toHaveURL(/program=/);
  const settled = page.url();
  const colleague = await browser.newPage();
  await colleague.goto(settled);
  await expect(verdict(colleague)).toContainText("can run");
  await expect(colleague.getByLabel("Set-up: x, mm")).toHaveValue(x);
  await expect(colleague.getByRole("listbox")).toContainText("GOTO/520,0,300");
  await colleague.close();
});

test.describe("lines that do not fit the set-up", () => {
  test.use({ provoked: [/status of 422/] });

  test("are listed, and what is shown meanwhile is called outdated", async ({ page }) => {
    const text = "UNITS/MM\nGOTO/0,0,320\nLOADTL/1\nGOTO/0,0,310\nLOADTL/2\nGOTO/10,0,310\n";
    await program(page, "tools.cls", text);
    await page.getByRole("radio", { name: "by tool" }).check();
    await expect(page.getByRole("button", { name: /^line 2: no length is in force here/ })).toBeVisible();
    await expect(page.getByTestId("outdated")).toBeVisible();
    await expect(page.getByRole("link", { name: "CSV" })).toHaveCount(0);
    await page.getByLabel("Before the first tool").selectOption("T1 is there");
    await expect(verdict(page)).toContainText("can run");
    // Each row is shown with its own tool.
    const second = page.getByLabel("Length of tool 2, mm");
    await second.fill("160");
    await second.press("Enter");
    await time(page).press("End");
    await expect(page.getByRole("spinbutton", { name: /Tool length/ })).toHaveValue("160.0");
    await time(page).press("Home");
    await expect(page.getByRole("spinbutton", { name: /Tool length/ })).toHaveValue("100.0");
    await expect(page.getByLabel("Z above the table, mm")).toHaveValue("320.0");
  });
});

test.describe("a long computation", () => {
  /** Moves to and fro; a fine tolerance makes many rows of each. */
  const moves = (count) =>
    `UNITS/MM\nFEDRAT/1000,MMPM\n${Array.from({ length: count }, (_, i) => `GOTO/${i % 2 === 0 ? -100 : 100},${i % 90},300\n`).join("")}`;

  test("is cancelled, and the program before remains usable", async ({ page, request }) => {
    await program(page, "many.cls", moves(20));
    await page.getByText("Tolerances and motion").click();
    await drop(page, "more.cls", moves(60_000));
    const progress = page.getByTestId("program-progress");
    await expect(progress).toContainText(/Planning … \d+ %/);
    await progress.getByRole("button", { name: "Cancel" }).click();
    await expect(page.getByTestId("program-trouble")).toHaveText("Cancelled.");
    const { jobs } = await (await request.get("/jobs")).json();
    expect(jobs[0].state).toBe("cancelled");
    await drop(page, "helix.ngc", HELIX);
    await expect(verdict(page)).toContainText("can run");
  });

  test("of too many rows is shown thinned, and the page says so", async ({ page }) => {
    await program(page, "fine.cls", moves(300));
    await page.getByText("Tolerances and motion").click();
    const tip = page.getByLabel("Greatest deviation of the tool’s end, mm");
    await tip.fill("0.00001");
    await tip.press("Enter");
    await expect(page.getByTestId("thinned")).toContainText("rows are too many for the page");
    await time(page).press("End");
    await expect(where(page)).toContainText("line 302");
  });
});
