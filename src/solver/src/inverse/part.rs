//! The whole machine: the tool's pose given in the table frame.

use super::track::Track;
use crate::angle::sin_cos;
use crate::limit::{Refusal, in_domain};
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

/// Eq (26) solved for P with theta2 = -phi2 (9) and theta1 = a - phi1 (14).
fn track(machine: &Machine, target: &PartPose, tool_length: f64) -> Result<Track, Refusal> {
    let PartPose { x, y, z, phi1, phi2 } = *target;
    in_domain(&[x, y, z, phi1, phi2, tool_length])?;
    let table = machine.table();
    let ((s1, c1), (s2, c2)) = (sin_cos(phi1), sin_cos(phi2));
    // theta2 = -phi2.
    let v1 = y * c2 - x * s2;
    let a = tool_length * s1 - v1;
    let b = table.dt - z - tool_length * c1;
    let (along, across) = (a * c1 + b * s1, a * s1 - b * c1);
    Ok(Track { x: x * c2 + y * s2, y: [0.0, along, across], z: [table.da, -across, along] })
}
