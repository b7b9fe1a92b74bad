//! The reason why slider positions have no assembly, or none in the working mode.

use std::f64::consts::{PI, TAU};

use super::elimination::Assembly;
use super::posture;
use crate::angle::sin_cos;
use crate::closure::{Closure, Roots, find_roots};
use crate::limit::{Constraint, Element, Margin};
use crate::machine::Machine;
use crate::margins::Margins;
use crate::posture::Posture;

/// Number of angles at which the closure is evaluated.
const TRIALS: u32 = 64;

/// The margin if no assembly exists: about the distance by which the legs fail to close, as a negative length margin.
/// It is the least root-mean-square error of the closure over the platform's angles, in mm.
#[cold]
pub(super) fn nearest(machine: &Machine, assembly: &Assembly) -> Margin {
    let miss = (0..TRIALS)
        .map(|i| miss_at(machine, assembly, TAU * f64::from(i) / f64::from(TRIALS) - PI))
        .fold(f64::INFINITY, f64::min);
    Margin { constraint: Constraint::LegLength, element: Element::Platform, value: -miss }
}

/// The error of the closure at one angle, mm.
fn miss_at(machine: &Machine, assembly: &Assembly, a: f64) -> f64 {
    let (s, c) = sin_cos(a);
    let size = 2.0 * machine.derived.scale;
    let missed = |w: f64| {
        let f = assembly.equations(c, s, w).f;
        f[0].abs().max(f[1].abs()) / size
    };
    match assembly.sheets(c, s) {
        Some([above, below]) => missed(above).min(missed(below)),
        None => missed(assembly.vertex(c, s)),
    }
}

/// The margin if assemblies exist, but none in the working mode: the worst margin of the assembly that is nearest to
/// it.
#[cold]
pub(super) fn out_of_mode(machine: &Machine, rho: [f64; 3], assembly: &Assembly) -> Margin {
    let mut roots = Roots::new();
    find_roots(assembly, PI, None, &mut roots);
    let nearest_to_working = roots
        .iter()
        .filter_map(|root| posture(machine, assembly, rho, root))
        .max_by(|a, b| mode_margin(machine, a).total_cmp(&mode_margin(machine, b)));
    match nearest_to_working {
        Some(posture) => Margins::of(machine, &posture, None).out_of_mode(),
        None => nearest(machine, assembly),
    }
}

/// The least of the quantities that must be positive in the working mode, relative to the rods.
fn mode_margin(machine: &Machine, posture: &Posture) -> f64 {
    let margins = Margins::of(machine, posture, None);
    let uncrossed = margins.rod_crossing / machine.derived.scale;
    margins.serial_singularity.iter().fold(uncrossed, |least, &m| least.min(m))
}
