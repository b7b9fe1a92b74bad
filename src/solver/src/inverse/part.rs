//! The whole machine: the tool's pose given in the table frame.

use crate::limit::Refusal;
use crate::machine::Machine;
use crate::pose::PartPose;
use crate::posture::{Posture, Postures};

/// All postures (up to 24) with the tool at `target` in the table frame. The table's angles of a
/// posture are [`table_angles`](crate::table_angles) of its alpha and the target's phi1 and phi2.
pub fn part(machine: &Machine, target: &PartPose, tool_length: f64) -> Result<Postures, Refusal> {
    let _ = (machine, target, tool_length);
    Err(Refusal::OutOfDomain)
}

/// The posture in the working mode with the tool at `target` in the table frame.
pub fn part_working(machine: &Machine, target: &PartPose, tool_length: f64) -> Result<Posture, Refusal> {
    let _ = (machine, target, tool_length);
    Err(Refusal::OutOfDomain)
}
