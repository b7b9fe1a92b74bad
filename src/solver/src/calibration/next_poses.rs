//! The poses to measure next.

use std::f64::consts::PI;

use nalgebra::{DMatrix, Vector3};

use super::measurements::Observed;
use super::model::{Model, State, TipRates};
use crate::inverse::tool_working;
use crate::machine::Machine;
use crate::margins::Margins;
use crate::parameter::{Parameter, ToolFrame};
use crate::pose::{PlatformPose, TableAngles};

/// Candidates from which poses are chosen.
const CANDIDATES: usize = 512;
/// Places that are examined for candidates.
const PLACES: usize = 16 * CANDIDATES;
/// Most measured poses from which a candidate's posture is found.
const STARTS: usize = 64;
/// Information about every unknown before the first measurement, relative to the greatest: so the determinant is not
/// zero, and a pose that determines a further combination is worth more than any other.
const FAINT: f64 = 1e-9;

/// Joints as the control indicates them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointReading {
    /// The sliders, mm.
    pub rho: [f64; 3],
    /// The table, rad. Only for tips in the part frame.
    pub table: Option<TableAngles>,
}

/// A pose that could be measured.
struct Candidate {
    reading: JointReading,
    rows: DMatrix<f64>,
}

/// Chooses poses within the machine's limits, each of which makes the determinant of the information matrix as great as
/// any candidate can, given those before it (Fedorov 1972: the D-optimal design, one point after the other).
///
/// `information` is the matrix so far, for measurements of the standard deviation `sigma`, and `machine` the one whose
/// sliders stand at their indicated positions plus the zero offsets of the state.
pub(super) fn next_poses(
    machine: &Machine,
    model: &Model<'_>,
    state: &State,
    (information, sigma): (&DMatrix<f64>, f64),
    count: usize,
) -> Vec<JointReading> {
    let unknowns = information.nrows();
    if count == 0 || unknowns == 0 {
        return Vec::new();
    }
    let faint = FAINT * information.diagonal().max().max(f64::MIN_POSITIVE);
    let regular = information + DMatrix::identity(unknowns, unknowns) * faint;
    let Some(mut covariance) = regular.try_inverse() else { return Vec::new() };
    let mut candidates = candidates(machine, model, state);
    for candidate in &mut candidates {
        candidate.rows /= sigma;
    }
    let mut chosen = Vec::with_capacity(count);
    while chosen.len() < count {
        let gain = |candidate: &Candidate| growth(&candidate.rows, &covariance).determinant();
        let best = candidates.iter().max_by(|a, b| gain(a).total_cmp(&gain(b)));
        let Some(Candidate { reading, rows }) = best else { break };
        let of_rows = rows * &covariance;
        let Some(inverse) = growth(rows, &covariance).try_inverse() else { break };
        covariance -= of_rows.tr_mul(&(inverse * &of_rows));
        chosen.push(*reading);
    }
    chosen
}

/// I + A C Aᵀ, whose determinant is the factor by which a measurement increases that of the information matrix.
fn growth(rows: &DMatrix<f64>, covariance: &DMatrix<f64>) -> DMatrix<f64> {
    DMatrix::identity(rows.nrows(), rows.nrows()) + rows * covariance * rows.transpose()
}

/// Feasible poses, spread over what can be measured.
fn candidates(machine: &Machine, model: &Model<'_>, state: &State) -> Vec<Candidate> {
    let first = model.rates(state).and_then(|rates| rates.first().copied());
    let places = (1..=PLACES).map(spread);
    let candidates = places.filter_map(|place| {
        let (reading, pose) = candidate_joints(machine, model, state, place)?;
        let at = rates(state, &reading, &pose)?;
        let rows = match (&model.measurements.observed, &first) {
            (Observed::Distances(_), Some(first)) => model.distance_row([first, &at]),
            _ => model.rows_at(state, &at),
        };
        Some(Candidate { reading, rows })
    });
    candidates.take(CANDIDATES).collect()
}

fn rates(state: &State, reading: &JointReading, pose: &PlatformPose) -> Option<TipRates> {
    let frame = reading.table.map_or(ToolFrame::Machine, ToolFrame::Part);
    let tip = Vector3::from(state.machine.tool(pose, frame).tip);
    let rates = state.machine.tool_rates(pose, reading.rho, frame)?.tip.map(Vector3::from);
    Some(TipRates { tip, rates })
}

/// The joints at a place of the unit cube with the platform's pose, if they are feasible.
fn candidate_joints(
    machine: &Machine,
    model: &Model<'_>,
    state: &State,
    place: [f64; 5],
) -> Option<(JointReading, PlatformPose)> {
    let limits = machine.limits();
    let within = |[low, high]: [f64; 2], fraction: f64| low + fraction * (high - low);
    let offsets = state.machine.slider_positions([0.0; 3]);
    let (pose, rho) = if let Observed::BallBar { lengths, .. } = &model.measurements.observed {
        let tip = state.centre + on_sphere(place) * median(lengths);
        let posture = tool_working(machine, tip.into(), state.machine.value(Parameter::ToolLength)).ok()?;
        (posture.pose, [0, 1, 2].map(|i| posture.rho[i] - offsets[i]))
    } else {
        let rho = [0, 1, 2].map(|i| within(limits.stroke[i], place[i]) - offsets[i]);
        (state.machine.platform_near(nearest(model, state, rho)?, rho)?, rho)
    };
    let table = matches!(model.measurements.observed, Observed::PartTips(_)).then(|| TableAngles {
        theta1: within(limits.tilt, place[3]),
        theta2: within(limits.rotary.unwrap_or([-PI, PI]), place[4]),
    });
    let margins = Margins::of_solution(machine, &pose, state.machine.slider_positions(rho), table);
    margins.feasible().then_some((JointReading { rho, table }, pose))
}

/// The pose of those of some measurements whose sliders are nearest.
fn nearest<'s>(model: &Model<'_>, state: &'s State, rho: [f64; 3]) -> Option<&'s PlatformPose> {
    let distance = |other: &[f64; 3]| (0..3).map(|i| (rho[i] - other[i]).powi(2)).sum::<f64>();
    let step = model.measurements.rho.len().div_ceil(STARTS);
    let poses = model.measurements.rho.iter().zip(&state.poses).step_by(step.max(1));
    let nearest = poses.min_by(|(a, _), (b, _)| distance(a).total_cmp(&distance(b)));
    nearest.map(|(_, pose)| pose)
}

/// A direction from two numbers between 0 and 1, uniform on the sphere.
fn on_sphere([a, b, ..]: [f64; 5]) -> Vector3<f64> {
    let (z, turn) = (2.0 * a - 1.0, 2.0 * PI * b);
    let radius = (1.0 - z * z).max(0.0).sqrt();
    Vector3::new(radius * turn.cos(), radius * turn.sin(), z)
}

fn median(lengths: &[f64]) -> f64 {
    let mut sorted = lengths.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or_default()
}

/// The i-th of places that fill the unit cube evenly: fractions of multiples of the powers of 1/g, where g is the root
/// of g⁶ = g + 1.
#[allow(clippy::cast_precision_loss, reason = "a number of places")]
fn spread(i: usize) -> [f64; 5] {
    const STEPS: [f64; 5] =
        [0.881_271_461_6, 0.776_639_389_1, 0.684_430_129_6, 0.603_168_740_7, 0.531_555_397_7];
    STEPS.map(|step| (0.5 + i as f64 * step).fract())
}
