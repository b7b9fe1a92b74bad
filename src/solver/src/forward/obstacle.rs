//! Why slider positions have no assembly, or none in the working mode.

use std::f64::consts::{PI, TAU};

use super::elimination::Assembly;
use super::posture;
use crate::angle::sin_cos;
use crate::closure::{Closure, Roots, find_roots};
use crate::limit::{Constraint, Element, Margin};
use crate::machine::Machine;
use crate::margins::Margins;
use crate::posture::Posture;

/// Angles at which a platform that cannot be assembled is tried.
const TRIALS: u32 = 64;

/// No assembly at all: the legs miss closing by at least about this much, as a negative length
/// margin. It is the least root-mean error of the closure over the platform's angles, in mm.
#[cold]
pub(super) fn nearest(machine: &Machine, assembly: &Assembly) -> Margin {
    let miss = (0..TRIALS)
        .map(|i| miss_at(machine, assembly, TAU * f64::from(i) / f64::from(TRIALS) - PI))
        .fold(f64::INFINITY, f64::min);
    Margin { constraint: Constraint::LegLength, element: Element::Platform, value: -miss }
}

/// How far the closure is from being satisfied at one angle, mm.
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

/// Assemblies exist, but none in the working mode: the worst margin of the one that comes nearest.
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

/// The least of what the working mode needs positive, relative to the rods.
fn mode_margin(machine: &Machine, posture: &Posture) -> f64 {
    let margins = Margins::of(machine, posture, None);
    let uncrossed = margins.rod_crossing / machine.derived.scale;
    margins.serial_singularity.iter().fold(uncrossed, |least, &m| least.min(m))
}
