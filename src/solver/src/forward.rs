//! Forward kinematics: from the sliders to the platform (section III.D).

mod elimination;
mod obstacle;

use std::f64::consts::PI;

use crate::closure::{Root, angle_of, roots};
use crate::limit::{Refusal, in_domain};
use crate::machine::Machine;
use crate::pose::PlatformPose;
use crate::posture::{Mode, Posture, Postures, Side};
use crate::residual::{residual, tolerance};
use elimination::Assembly;

/// All assembly modes (up to 8) for slider positions `rho`; at least one, or the refusal.
pub fn forward(machine: &Machine, rho: [f64; 3]) -> Result<Postures, Refusal> {
    let assembly = question(machine, rho)?;
    let mut postures = Postures::new();
    for root in roots(&assembly, PI, None) {
        postures.extend(posture(machine, &assembly, rho, &root));
    }
    if postures.is_empty() {
        Err(Refusal::Blocked(obstacle::nearest(machine, &assembly)))
    } else {
        Ok(postures)
    }
}

/// The assembly mode in the working mode, found without a start value.
pub fn forward_working(machine: &Machine, rho: [f64; 3]) -> Result<Posture, Refusal> {
    let assembly = question(machine, rho)?;
    // The rods of leg I do not cross for |a| below this, and there λ = w1/u is positive.
    let uncrossed = machine.derived.uncrossed;
    let found = roots(&assembly, uncrossed, Some(1.0))
        .iter()
        .filter_map(|root| posture(machine, &assembly, rho, root))
        .find(|posture| posture.working);
    found.ok_or_else(|| Refusal::Blocked(obstacle::out_of_mode(machine, rho, &assembly)))
}

fn question(machine: &Machine, rho: [f64; 3]) -> Result<Assembly, Refusal> {
    in_domain(&rho)?;
    let assembly = Assembly::new(machine, rho);
    if assembly.is_free(machine.derived.scale) { Err(Refusal::SelfMotion) } else { Ok(assembly) }
}

/// The posture of one root of the loop closure; `None` if it does not satisfy Eqs (3)-(6).
#[inline]
fn posture(machine: &Machine, assembly: &Assembly, rho: [f64; 3], root: &Root) -> Option<Posture> {
    let g = machine.geometry();
    let (u, v) = (g.R1 * root.c - g.r1, g.R1 * root.s);
    let w1 = root.w * u;
    let pose = PlatformPose {
        x: assembly.x1(root.c, root.s, root.w) - machine.derived.e1,
        y: -root.w * v,
        z: rho[0] + w1,
        alpha: angle_of(root.c, root.s),
    };
    let residual = residual(machine, &pose, rho);
    if residual > tolerance(machine, pose.z) {
        return None;
    }
    let q = g.R2 * root.s;
    let drops = [w1, pose.z - q - rho[1], pose.z + q - rho[2]];
    let legs = drops.map(Side::of);
    let working = u > 0.0 && w1 > v.abs() && drops[1] > 0.0 && drops[2] > 0.0;
    Some(Posture { pose, rho, mode: Mode { legs, crossed: u < 0.0 }, working, merged: root.merged, residual })
}
