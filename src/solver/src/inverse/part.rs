//! The whole machine: the tool's pose given in the table frame.

use super::track::Track;
use crate::angle::sin_cos;
use crate::limit::{Refusal, in_domain, in_proportion};
use crate::machine::Machine;
use crate::pose::PartPose;
use crate::posture::{Posture, Postures};

/// All postures (up to 24) with the tool at `target` in the table frame. The table's angles of a
/// posture are [`table_angles`](crate::table_angles) of its alpha and the target's phi1 and phi2.
pub fn part(machine: &Machine, target: &PartPose, tool_length: f64) -> Result<Postures, Refusal> {
    track(machine, target, tool_length)?.postures(machine)
}

/// The posture in the working mode with the tool at `target` in the table frame.
pub fn part_working(machine: &Machine, target: &PartPose, tool_length: f64) -> Result<Posture, Refusal> {
    track(machine, target, tool_length)?.working(machine)
}

/// All postures in the working mode with the tool at `target` in the table frame, that of [`part_working`] first. Nearly always
/// there is one; a tool far from the tilting axis, or a long one, can have several.
pub fn part_every_working(
    machine: &Machine,
    target: &PartPose,
    tool_length: f64,
) -> Result<Postures, Refusal> {
    track(machine, target, tool_length)?.every_working(machine)
}

/// Eq (26) solved for P with theta2 = -phi2 (9) and theta1 = a - phi1 (14).
fn track(machine: &Machine, target: &PartPose, tool_length: f64) -> Result<Track, Refusal> {
    let PartPose { x, y, z, phi1, phi2 } = *target;
    in_domain(machine, &[x, y, z, tool_length], &[phi1, phi2])?;
    let table = machine.table();
    let ((s1, c1), (s2, c2)) = (sin_cos(phi1), sin_cos(phi2));
    // theta2 = -phi2.
    let v1 = y * c2 - x * s2;
    let a = tool_length * s1 - v1;
    let b = table.dt - z - tool_length * c1;
    let (along, across) = (a * c1 + b * s1, a * s1 - b * c1);
    // P moves on a circle about the tilting axis, with the radius of (along, across).
    in_proportion(machine, &[along, across])?;
    Ok(Track { x: x * c2 + y * s2, y: [0.0, along, across], z: [table.da, -across, along] })
}
