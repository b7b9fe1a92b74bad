//! The tool centre point given in the base frame; alpha follows.

use super::track::Track;
use crate::limit::{Refusal, in_domain};
use crate::machine::Machine;
use crate::pose::Point;
use crate::posture::{Posture, Postures};

/// All postures (up to 24) with the tool centre point at `u` in the base frame.
pub fn tool(machine: &Machine, u: Point, tool_length: f64) -> Result<Postures, Refusal> {
    track(machine, u, tool_length)?.postures(machine)
}

/// The posture in the working mode with the tool centre point at `u` in the base frame.
pub fn tool_working(machine: &Machine, u: Point, tool_length: f64) -> Result<Posture, Refusal> {
    track(machine, u, tool_length)?.working(machine)
}

/// All postures in the working mode with the tool centre point at `u` in the base frame, that of [`tool_working`] first. Nearly always
/// there is one; a tool far from the tilting axis, or a long one, can have several.
pub fn tool_every_working(machine: &Machine, u: Point, tool_length: f64) -> Result<Postures, Refusal> {
    track(machine, u, tool_length)?.every_working(machine)
}

/// Eq (27) solved for P.
fn track(machine: &Machine, [x, y, z]: Point, tool_length: f64) -> Result<Track, Refusal> {
    in_domain(machine, &[x, y, z, tool_length], &[])?;
    Ok(Track { x, y: [y, 0.0, tool_length], z: [z, -tool_length, 0.0] })
}
