/** The view in the address, after the #: only what differs from the first view. */

import type { Machine, PlatformPose, WorkspaceKind } from "verne-client";
import {
  asDexterity,
  asErrors,
  asFamily,
  dexterityNumbers,
  errorsNumbers,
  familyWords,
} from "./section_words";
import { INITIAL, type Camera, type Ghosts, type Joints, type ProgramView, type View } from "./view";
import { packed, unpacked } from "./packed";

const KINDS: readonly WorkspaceKind[] = ["platform", "tool", "part"];
const GHOSTS: readonly Ghosts[] = ["none", "assembly", "platform", "inverse"];

export async function toAddress(view: View): Promise<string> {
  const { workspace: ws } = view;
  const base = INITIAL.workspace;
  const entries: [string, string | null][] = [
    ["machine", view.own || view.machine === INITIAL.machine ? null : view.machine],
    ["own", view.own && (await packed(view.own))],
    ["joints", view.joints && numbers([...view.joints.rho, view.joints.theta1, view.joints.theta2], 3)],
    ["mode", view.mode && numbers([view.mode.x, view.mode.y, view.mode.z, view.mode.alpha], 3)],
    ["tool", view.tool === INITIAL.tool ? null : String(view.tool)],
    ["radius", view.radius === INITIAL.radius ? null : String(view.radius)],
    ["clearance", view.clearance === null ? null : String(view.clearance)],
    ["drag", view.drag === INITIAL.drag ? null : view.drag],
    ["ghosts", view.ghosts === INITIAL.ghosts ? null : view.ghosts],
    ["workspace", !ws.shown ? "hidden" : ws.kind === base.kind ? null : ws.kind],
    ["kind", !ws.shown && ws.kind !== base.kind ? ws.kind : null],
    ["solid", ws.solid ? "1" : null],
    ["phi", ws.follows ? null : numbers([ws.phi1, ws.phi2], 3)],
    ["tolerance", ws.tolerance === base.tolerance ? null : String(ws.tolerance)],
    ["section", view.section === null ? null : numbers([view.section], 3)],
    ["program", view.program && (await packed(view.program))],
    ["family", view.family.open ? familyWords(view.family) : null],
    ["dexterity", view.dexterity.open ? dexterityNumbers(view.dexterity) : null],
    ["errors", view.errors.open ? errorsNumbers(view.errors) : null],
    ["atlas", view.atlas.open ? view.atlas.space : null],
    ["camera", view.camera && cameraNumbers(view.camera)],
  ];
  const said = entries.filter((entry): entry is [string, string] => entry[1] !== null);
  return said.map(([name, value]) => `${name}=${encodeURIComponent(value).replaceAll("%2C", ",")}`).join("&");
}

/** What an address says. */
export interface Said {
  view: View;
  /** The entries that cannot be read; the first view replaces them. */
  unread: string[];
}

export async function fromAddress(hash: string): Promise<Said> {
  const said = new Entries(hash);
  const base = INITIAL.workspace;
  const shown = said.text("workspace") !== "hidden";
  const phi = said.numbers("phi", 2);
  const atlas = said.oneOf("atlas", ["platform", "joints"] as const);
  const view: View = {
    machine: said.text("machine") ?? INITIAL.machine,
    own: said.check("own", asMachine(await unpacked(said.text("own")))),
    joints: asJoints(said.numbers("joints", 5)),
    mode: asPose(said.numbers("mode", 4)),
    tool: said.positive("tool") ?? INITIAL.tool,
    radius: said.positive("radius") ?? INITIAL.radius,
    clearance: said.positive("clearance") ?? INITIAL.clearance,
    drag: said.oneOf("drag", ["part", "tool"] as const) ?? INITIAL.drag,
    ghosts: said.oneOf("ghosts", GHOSTS) ?? INITIAL.ghosts,
    workspace: {
      shown,
      solid: said.oneOf("solid", ["0", "1"]) === "1",
      kind: (shown ? said.oneOf("workspace", KINDS) : said.oneOf("kind", KINDS)) ?? base.kind,
      follows: phi === null,
      phi1: phi?.[0] ?? base.phi1,
      phi2: phi?.[1] ?? base.phi2,
      tolerance: said.positive("tolerance") ?? base.tolerance,
    },
    section: said.numbers("section", 1)?.[0] ?? null,
    camera: asCamera(said.numbers("camera", 7) ?? said.numbers("camera", 6)),
    family: said.check("family", asFamily(said.text("family"))) ?? INITIAL.family,
    dexterity: said.check("dexterity", asDexterity(said.numbers("dexterity", 3))) ?? INITIAL.dexterity,
    errors: said.check("errors", asErrors(said.numbers("errors", 5))) ?? INITIAL.errors,
    atlas: atlas ? { open: true, space: atlas } : INITIAL.atlas,
    program: said.check("program", asProgram(await unpacked(said.text("program")))),
  };
  return { view, unread: said.unread() };
}

/** The entries of an address; it keeps which of them were read. */
class Entries {
  private readonly entries: URLSearchParams;
  private readonly read = new Set<string>();

  constructor(hash: string) {
    this.entries = new URLSearchParams(hash.replace(/^#/, ""));
  }

  text(name: string): string | null {
    return this.check(name, this.entries.get(name));
  }

  /** Notes that an entry could be read, unless its value is null. */
  check<T>(name: string, value: T | null): T | null {
    if (value === null) this.read.delete(name);
    else this.read.add(name);
    return value;
  }

  numbers(name: string, length: number): number[] | null {
    const words = this.entries.get(name)?.split(",") ?? [];
    const values = words.map((word) => (word.trim() === "" ? Number.NaN : Number(word)));
    return this.check(name, values.length === length && values.every(Number.isFinite) ? values : null);
  }

  positive(name: string): number | null {
    const value = this.numbers(name, 1)?.[0] ?? -1;
    return this.check(name, value >= 0 ? value : null);
  }

  oneOf<T extends string>(name: string, words: readonly T[]): T | null {
    const word = this.entries.get(name);
    return this.check(name, words.find((known) => known === word) ?? null);
  }

  unread(): string[] {
    return [...this.entries]
      .filter(([name]) => !this.read.has(name))
      .map(([name, value]) => `${name}=${value}`);
  }
}

function numbers(values: number[], decimals: number): string {
  return values.map((value) => String(Number(value.toFixed(decimals)) + 0)).join(",");
}

/** Anything may be packed; the service examines what looks like a machine. */
function asMachine(found: unknown): Machine | null {
  return typeof found === "object" && found !== null && "geometry" in found ? (found as Machine) : null;
}

function cameraNumbers({ eye, target, height }: Camera): string {
  return numbers([...eye, ...target, ...(height === null ? [] : [height])], 3);
}

function asJoints(list: number[] | null): Joints | null {
  if (!list) return null;
  const [r1, r2, r3, theta1, theta2] = list as [number, number, number, number, number];
  return { rho: [r1, r2, r3], theta1, theta2 };
}

function asPose(list: number[] | null): PlatformPose | null {
  if (!list) return null;
  const [x, y, z, alpha] = list as [number, number, number, number];
  return { x, y, z, alpha };
}

function asCamera(list: number[] | null): Camera | null {
  if (!list) return null;
  const [a, b, c, d, e, f] = list as [number, number, number, number, number, number];
  return { eye: [a, b, c], target: [d, e, f], height: list[6] ?? null };
}

function asProgram(found: unknown): ProgramView | null {
  const { id, name, settings } = (found ?? {}) as Partial<ProgramView>;
  return typeof id === "string" && typeof name === "string" ? { id, name, settings: settings ?? {} } : null;
}
