//! The tool centre point given in the base frame; alpha follows.

use crate::limit::Refusal;
use crate::machine::Machine;
use crate::pose::Point;
use crate::posture::{Posture, Postures};

/// All postures (up to 24) with the tool centre point at `u` in the base frame.
pub fn tool(machine: &Machine, u: Point, tool_length: f64) -> Result<Postures, Refusal> {
    let _ = (machine, u, tool_length);
    Err(Refusal::OutOfDomain)
}

/// The posture in the working mode with the tool centre point at `u` in the base frame.
pub fn tool_working(machine: &Machine, u: Point, tool_length: f64) -> Result<Posture, Refusal> {
    let _ = (machine, u, tool_length);
    Err(Refusal::OutOfDomain)
}
