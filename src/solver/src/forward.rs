//! Forward kinematics: from the sliders to the platform (section III.D).

mod box_search;
mod elimination;
mod family_edge;
mod infeasibility;
mod leg_one_chart;
mod rows;
mod working;

use std::f64::consts::PI;

use crate::error::KinematicsError;
use crate::loop_closure::{Root, Roots, determinant, find_roots, from_level_platform};
use crate::machine::Machine;
use crate::mechanism::Mechanism;
use crate::posture::{Posture, Postures, postures_or_error};
use crate::request_range::check_numbers;
use elimination::AssemblyClosure;

pub use rows::forward_working_rows;

/// Finds all assembly modes (up to 8) for slider positions `rho`.
///
/// # Units
///
/// `rho` is the sliders' z in the base frame, mm; z points down. The poses are in millimetres and radians.
///
/// # Errors
///
/// - [`KinematicsError::OutOfDomain`], [`KinematicsError::OutOfProportion`]: a number is out of range.
/// - [`KinematicsError::SelfMotion`]: the platform can move with all sliders locked.
/// - [`KinematicsError::Unreachable`]: no posture exists; the margin names the constraint that prevents it.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (3)-(6), (24), section III.D,
/// Fig. 6.
///
/// # Examples
///
/// ```
/// use verne_solver::{KinematicsError, Machine, forward};
///
/// let modes = forward(&Machine::verne(), [674.0, 685.0, 250.0])?;
/// assert_eq!(modes.len(), 4);
/// assert_eq!(modes.iter().filter(|posture| posture.working).count(), 1);
/// # Ok::<(), KinematicsError>(())
/// ```
pub fn forward(machine: &Machine, rho: [f64; 3]) -> Result<Postures, KinematicsError> {
    let mechanism = &machine.mechanism;
    if mechanism.at_family_edge {
        check_numbers(mechanism, &rho, &[])?;
        return family_edge::forward(machine, rho);
    }
    let closure = closure(mechanism, rho)?;
    let mut roots = Roots::new();
    // The working mode's posture is the one that `forward_working` answers, to the last bit.
    let level = from_level_platform(&closure);
    find_roots(&closure, PI, level, &mut roots);
    postures_or_error(
        |found| {
            found.extend(roots.iter().filter_map(|root| closure.posture(mechanism, rho, root)));
            let known = || level.and_then(|root| closure.posture(mechanism, rho, &root));
            working::put_working_first(machine, known, found);
        },
        || infeasibility::no_assembly(mechanism, &closure),
    )
}

/// Finds the assembly mode in the working mode. It needs no start value.
///
/// If there are several, which takes sliders far outside their strokes, it is one whose det_P has the sign of home.
///
/// # Units
///
/// `rho` is the sliders' z in the base frame, mm; z points down. The poses are in millimetres and radians.
///
/// # Errors
///
/// - [`KinematicsError::OutOfDomain`], [`KinematicsError::OutOfProportion`]: a number is out of range.
/// - [`KinematicsError::SelfMotion`]: the platform can move with all sliders locked.
/// - [`KinematicsError::Unreachable`]: no assembly mode is in the working mode; the margin names the constraint that
///   prevents it.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (3)-(6), section III.D.
///
/// # Examples
///
/// ```
/// use verne_solver::{KinematicsError, Machine, forward_working};
///
/// let posture = forward_working(&Machine::verne(), [674.0, 685.0, 250.0])?;
/// assert!((posture.pose.z - 1316.470).abs() < 1e-3);
/// assert!(posture.residual < 1e-9);
/// # Ok::<(), KinematicsError>(())
/// ```
pub fn forward_working(machine: &Machine, rho: [f64; 3]) -> Result<Posture, KinematicsError> {
    let mechanism = &machine.mechanism;
    if mechanism.at_family_edge {
        return working_at_family_edge(machine, rho);
    }
    let closure = closure(mechanism, rho)?;
    // Newton's method on the branch λ > 0 from the level platform finds the working mode in practice. Its result
    // counts only if it is in the working mode and on home's side of the singularity.
    let level = from_level_platform(&closure);
    if let Some(root) = level
        && on_home_side(machine, &closure, &root)
        && let Some(posture) = closure.posture(mechanism, rho, &root)
        && posture.working
    {
        return Ok(posture);
    }
    working_among_all(machine, &closure, rho, level)
}

/// [`forward_working`] of a machine with R1 = r1 or e1 = e2, or nearly so.
#[cold]
fn working_at_family_edge(machine: &Machine, rho: [f64; 3]) -> Result<Posture, KinematicsError> {
    check_numbers(&machine.mechanism, &rho, &[])?;
    if let Some(posture) = family_edge::working_from_home(machine, rho) {
        return Ok(posture);
    }
    let postures = family_edge::forward(machine, rho)?;
    let out_of_mode = || KinematicsError::Unreachable(infeasibility::out_of_mode(machine, &postures));
    postures.first().filter(|first| first.working).copied().ok_or_else(out_of_mode)
}

/// The posture in the working mode among all roots.
#[cold]
fn working_among_all(
    machine: &Machine,
    closure: &AssemblyClosure,
    rho: [f64; 3],
    known: Option<Root>,
) -> Result<Posture, KinematicsError> {
    let mechanism = &machine.mechanism;
    let mut found: Option<Posture> = None;
    let mut roots = Roots::new();
    // The rods of leg I cross beyond this angle.
    find_roots(closure, mechanism.uncrossed, known, &mut roots);
    for root in roots {
        let working = closure.posture(mechanism, rho, &root).filter(|posture| posture.working);
        let Some(posture) = working else { continue };
        if on_home_side(machine, closure, &root) {
            return Ok(posture);
        }
        found = found.or(Some(posture));
    }
    found.ok_or_else(|| KinematicsError::Unreachable(infeasibility::no_working(machine, rho, closure)))
}

/// Whether det_P has the sign of home. The closure's determinant is det_P times a factor that has the sign of e1 - e2.
#[inline(always)]
fn on_home_side(machine: &Machine, closure: &AssemblyClosure, root: &Root) -> bool {
    let factor = machine.mechanism.e1 - machine.mechanism.e2;
    determinant(closure, root) * factor * machine.home.det > 0.0
}

fn closure(mechanism: &Mechanism, rho: [f64; 3]) -> Result<AssemblyClosure, KinematicsError> {
    check_numbers(mechanism, &rho, &[])?;
    let closure = AssemblyClosure::new(mechanism, rho);
    if closure.has_self_motion(mechanism.longest) { Err(KinematicsError::SelfMotion) } else { Ok(closure) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parallel_matrix::{determinant as det_p, matrix};
    use crate::rods::Rods;

    #[test]
    fn the_closure_determinant_has_the_sign_of_det_p_times_the_offset() -> Result<(), KinematicsError> {
        let mut data = Machine::verne().data().clone();
        let g = &mut data.geometry;
        (g.D1, g.d1, g.D2, g.d2) = (g.D2, g.d2, g.D1, g.d1);
        let mirrored = Machine::new(data).map_err(|_| KinematicsError::SelfMotion)?;
        for machine in [Machine::verne(), mirrored] {
            let mechanism = &machine.mechanism;
            let rho = [674.0, 685.0, 250.0];
            let closure = closure(mechanism, rho)?;
            let mut roots = Roots::new();
            find_roots(&closure, PI, None, &mut roots);
            assert_eq!(roots.len(), 4);
            for root in roots {
                let pose = closure.posture(mechanism, rho, &root).map(|posture| posture.pose);
                let rods = Rods::of(mechanism, &pose.unwrap_or_default(), rho);
                let det = det_p(&matrix(machine.geometry(), &rods));
                assert!(determinant(&closure, &root) * (mechanism.e1 - mechanism.e2) * det > 0.0);
            }
        }
        Ok(())
    }
}
