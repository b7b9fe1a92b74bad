//! The forward problem of machines with R1 = r1 (linear deltas), with e1 = e2, and near both.
//!
//! There the elimination of [`super::elimination`] divides by numbers that are zero or small. The search over boxes
//! divides by none of them, and it finds every assembly whatever the difference is.

use super::box_search::{FoundAngles, all_angles};
use super::leg_one_chart::LegOneChart;
use super::working::{on_home_side, put_working_first};
use crate::error::KinematicsError;
use crate::interval::Interval;
use crate::limit::{Constraint, Element, Margin};
use crate::machine::Machine;
use crate::mechanism::Mechanism;
use crate::pose::PlatformPose;
use crate::posture::{Mode, Posture, Postures, Side, postures_or_error};
use crate::residual::{RESIDUAL_TOLERANCE, closed, magnitude};

/// Distance relative to the machine, and angle, within which two poses are one solution found twice.
const SAME: f64 = 1e-9;
/// The same for solutions that have merged.
const SAME_MERGED: f64 = 1e-5;
/// Angle, rad, that is zero up to rounding if R1 = r1: the platform does not turn.
const LEVEL: f64 = 1e-14;
/// Angles φ and θ at which the error of the closure is computed.
const SAMPLES: [u32; 2] = [128, 32];

/// All assemblies. The posture of [`working_from_home`] is among them to the last bit.
#[cold]
pub(super) fn forward(machine: &Machine, rho: [f64; 3]) -> Result<Postures, KinematicsError> {
    let mechanism = &machine.mechanism;
    let chart = LegOneChart::new(mechanism, rho);
    let angles = all_angles(&chart).map_err(|_| KinematicsError::SelfMotion)?;
    let known = working_from_home(machine, rho);
    postures_or_error(
        |found| {
            // A merged solution is one of the others unless it is far from all of them.
            for merged in [false, true] {
                for at in angles.iter().filter(|at| at.merged == merged) {
                    add(mechanism, &chart, rho, at, found);
                }
            }
            if let Some(known) = known {
                match found.iter_mut().find(|other| is_same(mechanism, other, &known, SAME)) {
                    Some(other) => *other = known,
                    None => _ = found.try_push(known),
                }
            }
            put_working_first(machine, || known, found);
        },
        || no_assembly(mechanism, &chart),
    )
}

/// The posture in the working mode that Newton's method finds from home, if it is on home's side of the singularity.
pub(super) fn working_from_home(machine: &Machine, rho: [f64; 3]) -> Option<Posture> {
    let mechanism = &machine.mechanism;
    let heights = machine.home.heights;
    let z = (0..3).map(|i| rho[i] + heights[i]).sum::<f64>() / 3.0;
    let start = PlatformPose { x: 0.0, y: 0.0, z, alpha: 0.0 };
    let posture = posture(mechanism, rho, start, false)?;
    (posture.working && on_home_side(machine, &posture)).then_some(posture)
}

fn add(mechanism: &Mechanism, chart: &LegOneChart, rho: [f64; 3], at: &FoundAngles, found: &mut Postures) {
    let start = chart.pose(at.angles);
    let Some(posture) = start.and_then(|start| posture(mechanism, rho, start, at.merged)) else { return };
    let within = if at.merged { SAME_MERGED } else { SAME };
    if !found.iter().any(|other| is_same(mechanism, other, &posture, within)) && !found.is_full() {
        found.push(posture);
    }
}

/// The posture that Newton's method on Eqs (3)-(6) finds from a pose; `None` if it finds none.
fn posture(mechanism: &Mechanism, rho: [f64; 3], start: PlatformPose, merged: bool) -> Option<Posture> {
    let found = closed(mechanism, start, rho)?;
    let (g, mut pose) = (&mechanism.geometry, found.pose);
    if mechanism.is_delta() && pose.alpha.abs() < LEVEL {
        pose.alpha = 0.0;
    }
    let s = pose.alpha.sin();
    let (v, q) = (g.R1 * s, g.R2 * s);
    let heights = [pose.z - rho[0], pose.z - q - rho[1], pose.z + q - rho[2]];
    let crossed = mechanism.crosses(pose.alpha);
    let working = !crossed && heights[0] > v.abs() && heights[1] > 0.0 && heights[2] > 0.0;
    let mode = Mode { legs: heights.map(Side::of), crossed };
    let holds = found.residual <= RESIDUAL_TOLERANCE * magnitude(mechanism, pose.z);
    holds.then_some(Posture { pose, rho, mode, working, merged, residual: found.residual })
}

fn is_same(mechanism: &Mechanism, a: &Posture, b: &Posture, within: f64) -> bool {
    let (p, q) = (&a.pose, &b.pose);
    let distance = (p.x - q.x).abs().max((p.y - q.y).abs()).max((p.z - q.z).abs());
    let (half, _) = (0.5 * (p.alpha - q.alpha)).sin_cos();
    distance <= within * magnitude(mechanism, p.z) && half.abs() <= within
}

/// The margin if no assembly exists: about the distance by which the legs fail to close.
fn no_assembly(mechanism: &Mechanism, chart: &LegOneChart) -> Margin {
    let angle = |i: u32, samples: u32| (f64::from(i) / f64::from(samples) - 0.5) * std::f64::consts::TAU;
    let size = 2.0 * mechanism.longest;
    let error = |phi: f64, theta: f64| {
        let equations = chart.equations([phi, theta].map(Interval::of))?;
        Some(equations.map(|jet| jet.value.low.abs() / size).into_iter().fold(0.0, f64::max))
    };
    let least = (0..SAMPLES[0])
        .flat_map(|i| (0..SAMPLES[1]).map(move |j| (i, j)))
        .filter_map(|(i, j)| error(angle(i, SAMPLES[0]), angle(j, SAMPLES[1])))
        .fold(f64::INFINITY, f64::min);
    let value = if least.is_finite() { -least } else { -size };
    Margin { constraint: Constraint::LegLength, element: Element::Platform, value }
}
