// Windows of the set-up: marks on sliders, what ends them, and values that are taken from them.
import { readFileSync } from "node:fs";
import { resolve } from "node:path";
import { expectAccessible, expectNothingOverflows, inEveryLook, scrollUp } from "./looks.mjs";
import { ask, drop, expect, open, test } from "./viewer.mjs";

const DOME = readFileSync(resolve(import.meta.dirname, "../../examples/dome.cls"), "utf8");
/** All of it is out of reach, and within reach elsewhere on the table. */
const ASIDE = "UNITS/MM\nRAPID\nGOTO/480,0,320\nFEDRAT/1000,MMPM\nGOTO/480,0,300\nGOTO/520,0,300\n";

const verdict = (page) => page.getByTestId("verdict");
const look = (page, spoken) => page.getByRole("button", { name: `Where does it run: ${spoken}`, exact: true });
const window = (page, spoken) => page.getByRole("region", { name: `Window: ${spoken}` });

async function program(page, name, text) {
  await open(page, "#workspace=hidden&tool=100");
  await drop(page, name, text);
  await expect(verdict(page)).toBeVisible();
}

test("the window of x is that of the service; its middle heals the program, and undo leads back", async ({ page, request }) => {
  await program(page, "aside.cls", ASIDE);
  await expect(verdict(page)).toContainText("cannot run");
  await look(page, "x of the set-up").click();
  const shown = window(page, "x of the set-up");
  const points = [[480, 0, 320], [480, 0, 300], [520, 0, 300]];
  const { intervals } = await ask(request, "/toolpath/window", {
    program: { points },
    tool_length: 100,
    parameter: "setup.x",
    from: -500,
    to: 500,
  });
  const [{ to }] = intervals;
  await expect(shown.getByRole("listitem")).toContainText(`to ${to < 0 ? "\u2212" : ""}${Math.abs(to).toFixed(1)}`);
  await expect(shown.getByRole("button", { name: /^above: line \d+, / })).toBeVisible();
  const slider = shown.getByRole("slider");
  await expect(slider).toHaveAttribute("aria-valuetext", /, the program fails$/);
  await shown.getByRole("button", { name: "take its middle" }).click();
  await expect(verdict(page)).toContainText("The machine can run the program.");
  // Its own value does not make a window outdated.
  await expect(slider).toHaveAttribute("aria-valuetext", /, the program runs$/);
  await expect(shown).not.toContainText("outdated");
  await page.getByRole("button", { name: "Undo", exact: true }).click();
  await expect(verdict(page)).toContainText("cannot run");
});

test("a click on the marks and the keys move the set-up", async ({ page }) => {
  await program(page, "aside.cls", ASIDE);
  await look(page, "x of the set-up").click();
  const slider = window(page, "x of the set-up").getByRole("slider");
  const { width, height } = await slider.boundingBox();
  await slider.click({ position: { x: width / 10, y: height / 2 } });
  const x = page.getByLabel("Set-up: x, mm");
  await expect.poll(async () => Number(await x.inputValue())).toBeLessThan(-350);
  await expect(verdict(page)).toContainText("The machine can run the program.");
  const before = Number(await x.inputValue());
  await slider.press("ArrowRight");
  await expect.poll(async () => Number(await x.inputValue())).toBeCloseTo(before + 0.1, 6);
});

test("a window of other settings is called outdated, and is looked for again", async ({ page }) => {
  await program(page, "dome.cls", DOME);
  await look(page, "length of the tool").click();
  const shown = window(page, "length of the tool");
  await expect(shown.getByRole("slider")).toBeVisible();
  const z = page.getByLabel("Set-up: z, mm");
  await z.fill("60");
  await z.press("Enter");
  await expect(shown).toContainText("outdated");
  await shown.getByRole("button", { name: "Look again" }).click();
  await expect(shown).not.toContainText("outdated");
  await expect(shown.getByRole("listitem")).toContainText("runs from");
  await look(page, "length of the tool").click();
  await expect(shown).toHaveCount(0);
});

test("windows have no accessibility violations, and nothing overflows", async ({ page }) => {
  await program(page, "dome.cls", DOME);
  for (const spoken of ["z of the set-up", "turn of the set-up about z", "length of the tool"]) {
    await look(page, spoken).click();
    await expect(window(page, spoken)).toBeVisible();
  }
  await inEveryLook(page, "windows", async () => {
    await scrollUp(page);
    await expectAccessible(page);
    await expectNothingOverflows(page, ".program");
  });
});
