//! Forward kinematics: from the sliders to the platform (section III.D).

use crate::limit::Refusal;
use crate::machine::Machine;
use crate::posture::{Posture, Postures};

/// All assembly modes (up to 8) for slider positions `rho`; at least one, or the refusal.
pub fn forward(machine: &Machine, rho: [f64; 3]) -> Result<Postures, Refusal> {
    let _ = (machine, rho);
    Err(Refusal::OutOfDomain)
}

/// The assembly mode in the working mode, found without a start value.
pub fn forward_working(machine: &Machine, rho: [f64; 3]) -> Result<Posture, Refusal> {
    let _ = (machine, rho);
    Err(Refusal::OutOfDomain)
}
