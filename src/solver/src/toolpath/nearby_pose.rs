//! The forward problem near a known pose: Newton's method from a guess.

use super::differential::Differential;
use crate::machine::Machine;
use crate::pose::PlatformPose;
use crate::residual::{errors, largest};
use crate::rods::Rods;

/// Newton steps at one place.
const STEPS: u32 = 8;
/// Newton steps with the differential of another place.
const CORRECTIONS: u32 = 3;
/// Error of a rod's length at which a pose is accurate enough, relative to the machine's longest dimension. The tool's
/// end is then off by some 1e-5 mm on a machine of one metre.
const ACCURACY: f64 = 2e-9;

/// A sum of poses with weights.
fn sum<const N: usize>(terms: [(f64, &PlatformPose); N]) -> PlatformPose {
    let of = |f: fn(&PlatformPose) -> f64| terms.iter().map(|(weight, pose)| weight * f(pose)).sum();
    PlatformPose { x: of(|p| p.x), y: of(|p| p.y), z: of(|p| p.z), alpha: of(|p| p.alpha) }
}

/// The middle of the cubic through the poses at the ends with their rates.
pub(super) fn hermite_middle([a, b]: [&PlatformPose; 2], rates: &[PlatformPose; 2]) -> PlatformPose {
    sum([(0.5, a), (0.5, b), (0.125, &rates[0]), (-0.125, &rates[1])])
}

/// The parabola through the poses at the ends and the middle.
pub(super) fn parabola([a, middle, b]: [&PlatformPose; 3], t: f64) -> PlatformPose {
    sum([((1.0 - t) * (1.0 - 2.0 * t), a), (4.0 * t * (1.0 - t), middle), (t * (2.0 * t - 1.0), b)])
}

/// The pose for given sliders near `guess`, with a differential nearby if that converges.
pub(super) fn solved(
    machine: &Machine,
    rho: [f64; 3],
    guess: PlatformPose,
    differential: &Differential,
) -> Option<PlatformPose> {
    corrected(machine, rho, guess, differential).or_else(|| newton(machine, rho, guess))
}

/// The pose for given sliders near `guess`.
fn newton(machine: &Machine, rho: [f64; 3], guess: PlatformPose) -> Option<PlatformPose> {
    let mut pose = guess;
    for _ in 0..STEPS {
        let differential = Differential::of(machine, &Rods::of(&machine.mechanism, &pose, rho))?;
        if let Some(pose) = corrected(machine, rho, pose, &differential) {
            return Some(pose);
        }
        pose = stepped(pose, &differential, errors(&machine.mechanism, &pose, rho));
    }
    None
}

/// The same with a known differential nearby; `None` if that does not converge.
fn corrected(
    machine: &Machine,
    rho: [f64; 3],
    guess: PlatformPose,
    differential: &Differential,
) -> Option<PlatformPose> {
    let mut pose = guess;
    for _ in 0..CORRECTIONS {
        let now = errors(&machine.mechanism, &pose, rho);
        if largest(&now) <= ACCURACY * machine.longest() {
            return Some(pose);
        }
        pose = stepped(pose, differential, now);
    }
    None
}

fn stepped(pose: PlatformPose, differential: &Differential, errors: [f64; 4]) -> PlatformPose {
    sum([(1.0, &pose), (-1.0, &differential.pose_change(errors))])
}
