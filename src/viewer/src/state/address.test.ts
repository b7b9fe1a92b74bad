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
    program: { id: "0a1b", name: "dôme.cls", settings: { setup: { x: 1, y: 2, z: 3, a: 0, b: 0, c: 90 } } },
  };
  expect(await fromAddress(`#${await toAddress(view)}`)).toEqual({ view, unread: [] });
});

test("a broken address shows the first view, and its entries are named", async () => {
  const broken =
    "joints=1,2&tool=-4&radius=x&clearance=-1&ghosts=all&workspace=moon&section=&camera=a,b,c,d,e,f&own=!!&colour=red";
  expect(await fromAddress(`#${broken}`)).toEqual({ view: INITIAL, unread: broken.split("&") });
});
