//! The answer of a calibration.

use nalgebra::Vector3;

use super::CalibrationError;
use super::fit::{Fit, Fitted};
use super::frame::MeasurementFrame;
use super::information::Information;
use super::loss::{Loss, Weighting, robust_scale};
use super::measurements::Observed;
use super::model::{State, TipRates};
use super::next_poses::{JointReading, next_poses};
use super::options::CalibrationOptions;
use super::outliers::{Outlier, ratio, threshold};
use super::unknown::Combination;
use crate::machine::Machine;
use crate::parallel_matrix::{determinant, matrix};
use crate::parameter::{ActualMachine, Parameter};
use crate::pose::{PlatformPose, Point};
use crate::residual::{errors, largest};
use crate::rods::Rods;

/// Error of a rod's length, relative to the machine, and of an angle, that is rounding.
const SAME: f64 = 1e-11;
/// Residuals below this fraction of the machine are rounding.
const ROUNDING: f64 = 1e-13;
/// Largest position of a slider in a machine, mm.
const FARTHEST: f64 = 1e6;

/// A parameter as the measurements determine it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The parameter.
    pub parameter: Parameter,
    /// The value at the start, mm or rad.
    pub start: f64,
    /// The value, mm or rad. A parameter that nothing determines stays as near to the start as it
    /// can.
    pub value: f64,
    /// The standard deviation of the value. `None` if neither the measurements nor a prior determine it, if the
    /// accuracy of the measurements is unknown, or at a bound.
    pub sigma: Option<f64>,
    /// Whether the measurements determine the parameter by themselves.
    pub identifiable: bool,
    /// Whether a bound keeps it from a value that fits better.
    pub at_bound: bool,
}

/// The answer of a calibration.
#[derive(Clone, Debug, PartialEq)]
pub struct Calibration {
    /// The machine. Its sliders stand at what the control indicates plus the zero offsets; so do the ends of its
    /// strokes.
    pub machine: Machine,
    /// The same with all parameters, for what the control indicates.
    pub actual: ActualMachine,
    /// The parameters that were determined.
    pub estimates: Vec<Estimate>,
    /// The frame of the measuring device, if it is an unknown.
    pub frame: Option<MeasurementFrame>,
    /// The ball's centre in the base frame, if there is a ball, mm.
    pub centre: Option<Point>,
    /// The number of independent combinations of unknowns that the measurements determine.
    pub rank: usize,
    /// Singular values of the derivatives of all measured numbers by all unknowns, in descending order; angles count by
    /// the machine's longest dimension. Zero where the measurements determine nothing.
    pub singular_values: Vec<f64>,
    /// What the measurements do not determine.
    pub unidentifiable: Vec<Combination>,
    /// The residual of each measurement, model less measured value, mm. That of a length is the first number.
    pub residuals: Vec<[f64; 3]>,
    /// Root mean square of all numbers of the residuals, mm.
    pub rms: f64,
    /// Standard deviation of a measured number, mm: the given one, or that of the residuals. `None` if there are no
    /// more numbers than `rank`, or if all residuals are rounding.
    pub sigma: Option<f64>,
    /// The measurements that their errors do not explain.
    pub outliers: Vec<Outlier>,
    /// Poses to measure next.
    pub next: Vec<JointReading>,
    /// The number of steps of the minimisation.
    pub steps: usize,
}

/// The answer from the end of a fit.
pub(super) fn concluded(
    machine: &Machine,
    fit: &Fit<'_>,
    start: &State,
    fitted: Fitted,
    options: &CalibrationOptions,
) -> Result<Calibration, CalibrationError> {
    let model = fit.model;
    let state = &fitted.state;
    let rates = fit.rates(state)?;
    let all = (0..model.unknowns.len()).collect();
    let of_measurements = Fit::information(&model.triangle(state, &rates, |_, _| 1.0), all, fitted.steps)?;
    let residuals = model.residuals(state);
    let sigma = standard_deviation(fit, &residuals, of_measurements.rank());
    let weighting = Weighting { scale: sigma.unwrap_or(1.0), ..fitted.weighting };
    let triangle = fit.triangle(state, &rates, &weighting);
    let free = fit.unbounded(&fitted, &triangle);
    let known = Fit::information(&triangle, free.clone(), fitted.steps)?;
    let calibrated = described(machine, state).ok_or(CalibrationError::OutOfMode { pose: 0 })?;
    check_postures(&calibrated, fit, state)?;
    let unidentifiable = of_measurements.undetermined().into_iter();
    let outliers = outliers(fit, state, &rates, &residuals, (&known, &weighting));
    let information = triangle.matrix().tr_mul(&triangle.matrix());
    Ok(Calibration {
        estimates: estimates(fit, start, state, &of_measurements, &known, sigma.is_some(), &free),
        frame: matches!(model.measurements.observed, Observed::TrackerTips(_)).then_some(state.frame),
        centre: matches!(model.measurements.observed, Observed::BallBar { .. }).then(|| state.centre.into()),
        rank: of_measurements.rank(),
        singular_values: of_measurements.singular_values(),
        unidentifiable: unidentifiable.map(|combination| model.named(combination)).collect(),
        rms: (sum_of_squares(&residuals) / numbers(fit)).sqrt(),
        residuals: residuals.iter().map(|residual| (*residual).into()).collect(),
        sigma,
        outliers,
        next: next_poses(&calibrated, model, state, (&information, weighting.scale), options.next),
        steps: fitted.steps,
        machine: calibrated,
        actual: fitted.state.machine,
    })
}

/// The machine whose sliders' positions include the zero offsets.
fn described(machine: &Machine, state: &State) -> Option<Machine> {
    let mut data = state.machine.machine().ok()?.data().clone();
    let offsets = state.machine.slider_positions([0.0; 3]);
    for (stroke, offset) in data.limits.stroke.iter_mut().zip(offsets) {
        *stroke = stroke.map(|end| (end + offset).clamp(-FARTHEST, FARTHEST));
    }
    data.drives = machine.data().drives;
    Machine::new(data).ok()
}

/// Checks that the answered machine stands in the working mode at every measured pose.
fn check_postures(machine: &Machine, fit: &Fit<'_>, state: &State) -> Result<(), CalibrationError> {
    let rho = &fit.model.measurements.rho;
    let stands = |(pose, rho): (&PlatformPose, &[f64; 3])| {
        is_working(machine, pose, state.machine.slider_positions(*rho))
    };
    match state.poses.iter().zip(rho).position(|at| !stands(at)) {
        Some(pose) => Err(CalibrationError::OutOfMode { pose }),
        None => Ok(()),
    }
}

/// Whether the rods close at a pose, in the working mode: every slider is above its end of the platform, leg I is not
/// crossed, and det_P has the sign of home.
fn is_working(machine: &Machine, pose: &PlatformPose, rho: [f64; 3]) -> bool {
    let mechanism = &machine.mechanism;
    let rods = Rods::of(mechanism, pose, rho);
    let closure = largest(&errors(mechanism, pose, rho)) <= SAME * mechanism.longest;
    let above = rods.directions.iter().all(|direction| direction[2] > 0.0);
    let uncrossed = pose.alpha.abs() <= mechanism.uncrossed + SAME;
    let det = determinant(&matrix(machine.geometry(), &rods));
    closure && above && uncrossed && det * machine.home.det > 0.0
}

/// The standard deviation of a measured number: the given one, or that of the residuals.
#[allow(clippy::cast_precision_loss, reason = "a number of measurements")]
fn standard_deviation(fit: &Fit<'_>, residuals: &[Vector3<f64>], rank: usize) -> Option<f64> {
    let spare = numbers(fit) - rank as f64;
    let from_residuals = || match fit.loss {
        Loss::Squares => (sum_of_squares(residuals) / spare).sqrt(),
        Loss::Huber => spread_of(fit, residuals, rank),
    };
    let is_known = |sigma: &f64| *sigma > ROUNDING * fit.model.length;
    fit.sigma.or_else(|| (spare > 0.0).then(from_residuals).filter(is_known))
}

/// The standard deviation of a measured number from the residuals' median.
#[allow(clippy::cast_precision_loss, reason = "a number of measurements")]
fn spread_of(fit: &Fit<'_>, residuals: &[Vector3<f64>], rank: usize) -> f64 {
    let components = fit.model.measurements.observed.components();
    let numbers = numbers(fit);
    let scale = robust_scale(residuals.iter().map(Vector3::norm), components);
    scale * (numbers / (numbers - rank as f64)).sqrt()
}

fn sum_of_squares(residuals: &[Vector3<f64>]) -> f64 {
    residuals.iter().map(Vector3::norm_squared).sum()
}

/// The number of measured numbers.
#[allow(clippy::cast_precision_loss, reason = "a number of measurements")]
fn numbers(fit: &Fit<'_>) -> f64 {
    (fit.model.measurements.count() * fit.model.measurements.observed.components()) as f64
}

fn estimates(
    fit: &Fit<'_>,
    start: &State,
    state: &State,
    of_measurements: &Information,
    known: &Information,
    has_sigma: bool,
    free: &[usize],
) -> Vec<Estimate> {
    let model = fit.model;
    let covariance = known.covariance(model.unknowns.len());
    let unknowns = model.unknowns.iter().enumerate();
    let parameters = unknowns.filter_map(|(i, unknown)| Some((i, *unknown, unknown.parameter()?)));
    let estimate = |(i, unknown, parameter)| Estimate {
        parameter,
        start: start.machine.value(parameter),
        value: state.machine.value(parameter),
        sigma: (has_sigma && known.determines(i)).then(|| covariance[(i, i)].sqrt() / model.scale(unknown)),
        identifiable: of_measurements.determines(i),
        at_bound: !free.contains(&i),
    };
    parameters.map(estimate).collect()
}

/// The measurements that their errors do not explain, the worst first.
fn outliers(
    fit: &Fit<'_>,
    state: &State,
    rates: &[TipRates],
    residuals: &[Vector3<f64>],
    (known, weighting): (&Information, &Weighting),
) -> Vec<Outlier> {
    let model = fit.model;
    let spread = fit.sigma.unwrap_or_else(|| spread_of(fit, residuals, known.rank()));
    if !(spread.is_finite() && spread > ROUNDING * model.length) {
        return Vec::new();
    }
    let covariance = known.covariance(model.unknowns.len());
    let components = weighting.components;
    let limit = threshold(components * residuals.len());
    let outlier = |(measurement, residual): (usize, &Vector3<f64>)| {
        let rows = model.rows(state, rates, measurement) / weighting.scale;
        let weight = weighting.weight(residual.norm());
        let ratio = ratio(&(residual / spread), &rows, &covariance, weight)?;
        (ratio > limit).then(|| Outlier { measurement, residual: residual.norm(), ratio })
    };
    let mut found: Vec<_> = residuals.iter().enumerate().filter_map(outlier).collect();
    found.sort_by(|a, b| b.ratio.total_cmp(&a.ratio));
    found
}
