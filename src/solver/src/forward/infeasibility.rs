//! The constraint that prevents an assembly of slider positions, or one in the working mode.

use std::f64::consts::{PI, TAU};

use super::elimination::AssemblyClosure;
use crate::fast_math::sin_cos;
use crate::limit::{Constraint, Element, Margin};
use crate::loop_closure::{LoopClosure, Roots, find_roots};
use crate::machine::Machine;
use crate::margins::Margins;
use crate::mechanism::Mechanism;
use crate::posture::{Posture, Postures};

/// Number of angles at which the closure is evaluated.
const SAMPLES: u32 = 64;

/// The margin if no assembly exists: about the distance by which the legs fail to close, as a negative length margin.
/// It is the least error of the closure over the platform's angles, in mm.
#[cold]
pub(super) fn no_assembly(mechanism: &Mechanism, closure: &AssemblyClosure) -> Margin {
    let error = (0..SAMPLES)
        .map(|i| error_at(mechanism, closure, TAU * f64::from(i) / f64::from(SAMPLES) - PI))
        .fold(f64::INFINITY, f64::min);
    Margin { constraint: Constraint::LegLength, element: Element::Platform, value: -error }
}

/// The error of the closure at one angle, mm.
fn error_at(mechanism: &Mechanism, closure: &AssemblyClosure, a: f64) -> f64 {
    let (s, c) = sin_cos(a);
    let size = 2.0 * mechanism.longest;
    let error = |w: f64| {
        let f = closure.equations(c, s, w).f;
        f[0].abs().max(f[1].abs()) / size
    };
    match closure.branches(c, s) {
        Some([above, below]) => error(above).min(error(below)),
        None => error(closure.vertex(c, s)),
    }
}

/// The margin if no assembly is in the working mode.
#[cold]
pub(super) fn no_working(machine: &Machine, rho: [f64; 3], closure: &AssemblyClosure) -> Margin {
    let mut roots = Roots::new();
    find_roots(closure, PI, None, &mut roots);
    let postures: Postures =
        roots.iter().filter_map(|root| closure.posture(&machine.mechanism, rho, root)).collect();
    if postures.is_empty() {
        no_assembly(&machine.mechanism, closure)
    } else {
        out_of_mode(machine, &postures)
    }
}

/// The margin if assemblies exist, but none in the working mode: the worst margin of the assembly that is nearest to
/// it.
#[cold]
pub(super) fn out_of_mode(machine: &Machine, postures: &Postures) -> Margin {
    let nearest_to_working =
        postures.iter().max_by(|a, b| mode_margin(machine, a).total_cmp(&mode_margin(machine, b)));
    match nearest_to_working {
        Some(posture) => Margins::of(machine, posture, None).out_of_mode(),
        None => Margin { constraint: Constraint::LegLength, element: Element::Platform, value: 0.0 },
    }
}

/// The least of the quantities that must be positive in the working mode, relative to the rods.
fn mode_margin(machine: &Machine, posture: &Posture) -> f64 {
    let margins = Margins::of(machine, posture, None);
    let uncrossed = margins.rod_crossing.unwrap_or(machine.mechanism.longest) / machine.mechanism.longest;
    margins.serial_singularity.iter().fold(uncrossed, |least, &m| least.min(m))
}
