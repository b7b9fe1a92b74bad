import { expect, test } from "vitest";
import { fromAddress, toAddress } from "./address";
import { VERNE } from "./verne.fixture";
import { INITIAL, type View } from "./view";

test("the first view needs no words", async () => {
  expect(await toAddress(INITIAL)).toBe("");
  expect(await fromAddress("")).toEqual({ view: INITIAL, unread: [] });
});

test("a view comes back from its address", async () => {
  const view: View = {
    machine: "verne",
    own: { ...VERNE, name: "fräs & dreh" },
    joints: { rho: [674, 685.125, 250], theta1: -12.5, theta2: 30 },
    mode: { x: -298.038, y: 370.105, z: 1142.842, alpha: 131.984 },
    tool: 80.5,
    radius: 12.5,
    clearance: 0,
    drag: "tool",
    ghosts: "assembly",
    workspace: {
      shown: false,
      solid: true,
      kind: "tool",
      follows: false,
      phi1: 20,
      phi2: -45,
      tolerance: 0.1,
    },
    section: 312.5,
    camera: { eye: [3, 2, 1], target: [0, -1.1, 0], height: 2.25 },
    family: {
      open: true,
      parameter: "phi1",
      ranges: { ...INITIAL.family.ranges, phi1: { from: -12.5, to: 30, count: 5 } },
    },
    dexterity: { open: true, from: -10, to: 35.5, cell: 80 },
    errors: { open: true, tolerances: { rods: 0.05, sliders: 0, joints: 0.015, axes: 1, angles: 0.002 } },
    atlas: { open: true, space: "joints" },
    program: { id: "0a1b", name: "dôme.cls", settings: { setup: { x: 1, y: 2, z: 3, a: 0, b: 0, c: 90 } } },
  };
  expect(await fromAddress(`#${await toAddress(view)}`)).toEqual({ view, unread: [] });
});

test("a section that is closed needs no words", async () => {
  const { family, dexterity } = INITIAL;
  const changed = {
    ...INITIAL,
    family: { ...family, parameter: "phi1" as const },
    dexterity: { ...dexterity, cell: 80 },
  };
  expect(await toAddress(changed)).toBe("");
  const opened = { ...INITIAL, family: { ...family, open: true }, dexterity: { ...dexterity, open: true } };
  expect(await toAddress(opened)).toBe("family=tool,0,300,13&dexterity=-20,20,40");
});

test("a broken address shows the first view, and its entries are named", async () => {
  const broken =
    "joints=1,2&tool=-4&radius=x&clearance=-1&ghosts=all&workspace=moon&section=&camera=a,b,c,d,e,f&own=!!&colour=red&dexterity=0,1,2&errors=1,2,3,4,-5&atlas=moon";
  expect(await fromAddress(`#${broken}`)).toEqual({ view: INITIAL, unread: broken.split("&") });
});

test.each([
  "mass,0,1,5",
  "tool,0,1",
  "tool,0,1,1",
  "tool,0,1,2.5",
  "tool,,1,5",
  "phi1,0,x,5",
  "phi1,0,1,102",
  "tool,-1,50,4",
])("a family of %s cannot be read", async (words) => {
  expect(await fromAddress(`#family=${words}`)).toEqual({ view: INITIAL, unread: [`family=${words}`] });
});
