/** Where the machine shall go. */

import type { PlatformPose, Schemas } from "verne-client";
import type { Joints } from "./view";

export type PartPose = Schemas["TargetPose"] & { phi1: number; phi2: number };

export type Target =
  | { by: "joints"; joints: Joints; mode?: PlatformPose | null }
  | { by: "part"; pose: PartPose }
  | { by: "tool" | "platform"; pose: { x: number; y: number; z: number } };

/** The tip that is wanted, with its frame; null where joints or a place of the platform are wanted. */
export function wantedTip(
  target: Target,
): { frame: "part" | "base"; x: number; y: number; z: number } | null {
  if (target.by === "joints" || target.by === "platform") return null;
  const { x, y, z } = target.pose;
  return { frame: target.by === "part" ? "part" : "base", x, y, z };
}
