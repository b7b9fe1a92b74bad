/** What is looked at: everything that a colleague needs to see the same. */

import type { AtlasSpace, Machine, PlatformPose, WorkspaceKind } from "verne-client";
import type { Settings } from "../program/settings";

/** Solutions with the same sliders (assembly), the same platform position, or the same tool pose. */
export type Ghosts = "none" | "assembly" | "platform" | "inverse";

export interface View {
  /** A published machine's name, unless `own` is there. */
  machine: string;
  /** A machine that was dropped on the page. */
  own: Machine | null;
  /** Null: at home. */
  joints: Joints | null;
  /** The pose of another assembly mode than the working one. */
  mode: PlatformPose | null;
  /** mm from P to the tip. */
  tool: number;
  /** Radius of the tool's end, mm. */
  radius: number;
  /** Least height of tool and platform over the table, mm. Null: the machine's own, or 0. */
  clearance: number | null;
  /** What the tool keeps when it is dragged: its angles on the part, or the table's. */
  drag: "part" | "tool";
  ghosts: Ghosts;
  workspace: WorkspaceView;
  /** Height of the cut in the workspace's frame, mm. */
  section: number | null;
  camera: Camera | null;
  program: ProgramView | null;
  family: FamilyView;
  dexterity: DexterityView;
  errors: ErrorsView;
  atlas: AtlasView;
}

/** The section for the errors of the tool, with its settings. */
export interface ErrorsView {
  open: boolean;
  tolerances: Readonly<ErrorTolerances>;
}

/** One tolerance for each group of the machine's parameters: of the table's directions in degrees, else in mm. */
export interface ErrorTolerances {
  rods: number;
  sliders: number;
  joints: number;
  axes: number;
  angles: number;
}

/** The section for the map of solutions, with its plane. */
export interface AtlasView {
  open: boolean;
  space: AtlasSpace;
}

/** The section for families of workspaces, with its settings. */
export interface FamilyView {
  open: boolean;
  parameter: FamilyParameter;
  ranges: Readonly<Record<FamilyParameter, ValueRange>>;
}

/** The parameters over which the page shows families. */
export type FamilyParameter = "tool_length" | "phi1";

/** Values at equal distances; mm for the tool length, degrees for phi1. */
export interface ValueRange {
  from: number;
  to: number;
  /** The number of values, both ends included. */
  count: number;
}

/** Fewest and most workspaces of one family on the page. The service takes up to 1000. */
export const FAMILY_COUNTS = { least: 2, greatest: 101 };

/** The section for dexterity maps, with its settings. */
export interface DexterityView {
  open: boolean;
  /** The range of inclinations, degrees. */
  from: number;
  to: number;
  /** Distance between neighbouring points, mm. */
  cell: number;
}

/** Least and greatest distance between the points of a map, mm. */
export const CELLS = { least: 10, greatest: 1000 };

/** A program that the service keeps. */
export interface ProgramView {
  id: string;
  /** The name of its file. */
  name: string;
  /** What differs from the defaults. */
  settings: Partial<Settings>;
}

export interface Joints {
  rho: [number, number, number];
  theta1: number;
  theta2: number;
}

export interface WorkspaceView {
  shown: boolean;
  solid: boolean;
  kind: WorkspaceKind;
  /** Whether the tool's angles on the part are those of the machine, or phi1 and phi2 below. */
  follows: boolean;
  phi1: number;
  phi2: number;
  tolerance: number;
}

/** Eye and target in the scene, metres. */
export interface Camera {
  eye: [number, number, number];
  target: [number, number, number];
  /** The height of the picture in the scene, metres, of a camera without perspective; null with perspective. */
  height: number | null;
}

export const INITIAL: View = {
  machine: "verne",
  own: null,
  joints: null,
  mode: null,
  tool: 50,
  radius: 0,
  clearance: null,
  drag: "part",
  ghosts: "none",
  workspace: { shown: true, solid: false, kind: "part", follows: true, phi1: 0, phi2: 0, tolerance: 1 },
  section: null,
  camera: null,
  program: null,
  family: {
    open: false,
    parameter: "tool_length",
    ranges: { tool_length: { from: 0, to: 300, count: 13 }, phi1: { from: -40, to: 40, count: 17 } },
  },
  dexterity: { open: false, from: -20, to: 20, cell: 40 },
  errors: { open: false, tolerances: { rods: 0.02, sliders: 0.01, joints: 0.02, axes: 0.02, angles: 0.002 } },
  atlas: { open: false, space: "platform" },
};
