// Where to clamp the part: a set-up that is found, used and taken back.
import { readFileSync } from "node:fs";
import { resolve } from "node:path";
import { expectAccessible, expectNothingOverflows, inEveryLook, scrollUp } from "./looks.mjs";
import { drop, expect, open, test } from "./viewer.mjs";

const DOME = readFileSync(resolve(import.meta.dirname, "../../examples/dome.cls"), "utf8");
/** All of it is out of reach, and within reach elsewhere on the table. */
const ASIDE = "UNITS/MM\nRAPID\nGOTO/480,0,320\nFEDRAT/1000,MMPM\nGOTO/480,0,300\nGOTO/520,0,300\n";

const verdict = (page) => page.getByTestId("verdict");
const answer = (page) => page.getByTestId("placement");
const press = (page, name) => page.getByRole("button", { name, exact: true }).click();

async function program(page, name, text) {
  await open(page, "#workspace=hidden&tool=100");
  await drop(page, name, text);
  await expect(verdict(page)).toBeVisible();
}

async function search(page) {
  await press(page, "Find a set-up");
  await press(page, "Search");
  await expect(answer(page)).toBeVisible();
}

test("a set-up is found for a program that fails, used, and undone", async ({ page }) => {
  await program(page, "aside.cls", ASIDE);
  await expect(verdict(page)).toContainText("cannot run");
  await press(page, "Find a set-up");
  const least = page.getByLabel("Least x of the set-up, mm");
  await least.fill("-500");
  await least.press("Enter");
  await press(page, "Search");
  await expect(answer(page).getByRole("row", { name: /^Program fails runs$/ })).toBeVisible();
  await expect(answer(page).getByRole("row", { name: /^Keeps .* times the reserve$/ })).toBeVisible();
  await expect(answer(page)).toContainText("it is not proved that no other set-up is better");
  await press(page, "Use this set-up");
  await expect(verdict(page)).toContainText("The machine can run the program.");
  await expect(answer(page)).toContainText("This set-up is in use.");
  await expect(page.getByLabel("Set-up: x, mm")).not.toHaveValue("0.000");
  await press(page, "Undo");
  await expect(verdict(page)).toContainText("cannot run");
  await expect(page.getByLabel("Set-up: x, mm")).toHaveValue("0.000");
  await expect(page.getByRole("button", { name: "Use this set-up" })).toBeVisible();
  // The answer is about other settings as soon as one is changed.
  const turn = page.getByLabel("Set-up: turn about z, degrees");
  await turn.fill("10");
  await turn.press("Enter");
  await expect(answer(page)).toContainText("outdated");
  await press(page, "Discard");
  await expect(answer(page)).toHaveCount(0);
});

test("a line that limits the set-up is shown in the text, and the machine moves there", async ({ page }) => {
  await program(page, "dome.cls", DOME);
  await search(page);
  const limit = answer(page).getByRole("list", { name: "Limited by" }).getByRole("button").first();
  const line = /^line (\d+):/.exec(await limit.textContent())[1];
  await limit.focus();
  await page.keyboard.press("Enter");
  await expect(page.locator('.text-list [aria-selected="true"]')).toHaveId(`line-${line}`);
});

test("nothing is searched for while nothing may change", async ({ page }) => {
  await program(page, "aside.cls", ASIDE);
  await press(page, "Find a set-up");
  for (const axis of ["x", "y", "z"]) await page.getByLabel(`The ${axis} of the set-up may change`).uncheck();
  await expect(page.getByRole("button", { name: "Search", exact: true })).toBeDisabled();
  await expect(page.getByText("Choose something that may change.")).toBeVisible();
});

test("a search is cancelled", async ({ page }) => {
  // A service that has answered this before would answer at once: the program is another one each time.
  const y = (Date.now() % 1e6) / 1e5;
  const moves = Array.from({ length: 20_000 }, (_, i) => `GOTO/${i % 2 === 0 ? -100 : 100},${y + (i % 90)},300\n`);
  await program(page, "many.cls", `UNITS/MM\nFEDRAT/1000,MMPM\n${moves.join("")}`);
  await press(page, "Find a set-up");
  await press(page, "Search");
  const progress = page.getByText(/^Searching for a set-up …/);
  await expect(progress).toBeVisible();
  await page.locator(".placement").getByRole("button", { name: "Cancel" }).click();
  await expect(page.locator(".placement").getByText("Cancelled.")).toBeVisible();
});

test("a set-up that was found has no accessibility violations, and nothing overflows", async ({ page }) => {
  await program(page, "dome.cls", DOME);
  await search(page);
  await inEveryLook(page, "placement", async () => {
    await scrollUp(page);
    await expectAccessible(page);
    await expectNothingOverflows(page, ".program");
  });
});
