//! The parallel module: P given in the base frame.

use crate::limit::Refusal;
use crate::machine::Machine;
use crate::pose::Point;
use crate::posture::{Posture, Postures};

/// All postures (up to 16) with the platform at `p` in the base frame; at least one, or the refusal.
pub fn platform(machine: &Machine, p: Point) -> Result<Postures, Refusal> {
    let _ = (machine, p);
    Err(Refusal::OutOfDomain)
}

/// The posture in the working mode with the platform at `p` in the base frame.
pub fn platform_working(machine: &Machine, p: Point) -> Result<Posture, Refusal> {
    let _ = (machine, p);
    Err(Refusal::OutOfDomain)
}
