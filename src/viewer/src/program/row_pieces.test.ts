import { tableFromArrays, tableToIPC } from "@uwdata/flechette";
import { expect, test, vi } from "vitest";
import { VERNE } from "../state/verne.fixture";

// The client needs the address of a page.
vi.stubGlobal("document", { baseURI: "http://localhost/" });
const { pieceOf } = await import("./row_pieces");

const MACHINE = {
  ref: "verne",
  definition: VERNE,
  hash: "",
  home: {
    det: 1.2,
    rodDistance: 140,
    joints: { rho: [0, 0, 0] as [number, number, number], theta1: 0, theta2: 0 },
  },
};

test("rows in Arrow become columns; margins are fractions of the ranges of their limits", () => {
  const numbers = Object.fromEntries(
    ["x", "y", "z", "i", "j", "k", "rho1", "rho2", "rho3", "theta1", "theta2"].map((name, i) => [
      name,
      Float64Array.from([i, i + 0.5]),
    ]),
  );
  const table = tableFromArrays({
    line: Uint32Array.from([4, 7]),
    kind: ["rapid", "feed"],
    ...numbers,
    duration: [null, 1.5],
    margin: Float64Array.from([-75, 21]),
    constraint: ["stroke", "slider_joint"],
    element: ["slider2.max", "rod21"],
  });
  const piece = pieceOf(tableToIPC(table, { format: "stream" }) ?? new Uint8Array(), 100, MACHINE);
  expect(piece.count).toBe(2);
  expect([...piece.number]).toEqual([100, 101]);
  expect([...piece.line]).toEqual([4, 7]);
  expect(piece.kind).toEqual(["rapid", "feed"]);
  expect([...piece.tip]).toEqual([0, 1, 2, 0.5, 1.5, 2.5]);
  expect([...piece.joints.theta2]).toEqual([10, 10.5]);
  expect([...piece.duration]).toEqual([Number.NaN, 1.5]);
  expect([...piece.fraction]).toEqual([-75 / 750, 21 / 42]);
  expect(piece.limit[1]).toEqual({ constraint: "slider_joint", element: "rod21" });
});
