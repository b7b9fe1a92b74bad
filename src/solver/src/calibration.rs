//! Calibration: the parameters of a machine from measurements, by least squares.
//!
#![doc = include_str!("calibration/calibration.md")]

mod ball;
mod decomposition;
mod error;
mod estimate;
mod fit;
mod frame;
mod information;
mod loss;
mod measurements;
mod model;
mod next_poses;
mod options;
mod outliers;
mod simulation;
mod start;
mod triangle;
mod unknown;

pub use error::CalibrationError;
pub use estimate::{Calibration, Estimate};
pub use frame::MeasurementFrame;
pub use loss::Loss;
pub use measurements::{Measurements, Observed, PartTip, TipDistance};
pub use next_poses::JointReading;
pub use options::{CalibrationOptions, Prior};
pub use outliers::Outlier;
pub use simulation::{Plan, simulated};
pub use unknown::{Combination, FrameAxis, Unknown};

use nalgebra::DVector;

use crate::machine::Machine;
use crate::parameter::Parameter;
use crate::workspace::Observer;
use decomposition::decomposed;
use estimate::concluded;
use fit::{Fit, Fitted, Knowledge};
use model::{Model, State};

/// Part of a combination in the machine's parameters below which it is one of the measuring device alone.
const LEAST_SHARE: f64 = 1e-6;

/// Determines a machine's parameters from measurements, from those of `machine` and a tool of length `tool_length` as
/// the start.
///
/// # Units
///
/// Millimetres and radians.
///
/// # Errors
///
/// [`CalibrationError`]
///
/// # References
///
/// Levenberg 1944, [doi:10.1090/qam/10666](https://doi.org/10.1090/qam/10666); Marquardt 1963,
/// [doi:10.1137/0111030](https://doi.org/10.1137/0111030).
///
/// # Examples
///
/// ```
/// use verne_solver::calibration::{CalibrationError, CalibrationOptions, Plan, calibrated, simulated};
/// use verne_solver::parameter::{ActualMachine, Parameter};
/// use verne_solver::workspace::Unobserved;
/// use verne_solver::Machine;
///
/// let nominal = Machine::verne();
/// let actual = ActualMachine::new(&nominal, 100.0).with([(Parameter::L1, 0.3), (Parameter::o2, -0.1)]);
/// let rho = (0..30).map(|i| {
///     let i = f64::from(i);
///     [500.0 + 120.0 * (0.7 * i).sin(), 450.0 + 120.0 * (1.3 * i).sin(), 450.0 + 120.0 * (2.1 * i).cos()]
/// });
/// let measured = simulated(&actual, rho.collect(), &Plan::Tips)?;
/// let options = CalibrationOptions { sigma: Some(0.002), ..CalibrationOptions::default() };
/// let found = calibrated(&nominal, 100.0, &measured, &options, &Unobserved)?;
/// assert_eq!(found.rank, 13);
/// assert!((found.machine.data().geometry.L1 - 1050.3).abs() < 1e-4);
/// # Ok::<(), CalibrationError>(())
/// ```
pub fn calibrated(
    machine: &Machine,
    tool_length: f64,
    measurements: &Measurements,
    options: &CalibrationOptions,
    observer: &dyn Observer,
) -> Result<Calibration, CalibrationError> {
    measurements.check()?;
    let start = start::start(machine, tool_length, measurements)?;
    let free = free_parameters(machine, measurements, options);
    let model = Model::new(measurements, &free, &start, machine.longest());
    let knowledge: Vec<_> = model.unknowns.iter().map(|unknown| known(&model, options, *unknown)).collect();
    let fit =
        Fit { model: &model, knowledge: &knowledge, loss: options.loss, sigma: options.sigma, observer };
    let fitted = fit.run(start.clone())?;
    let nearest = nearest_to_start(&fit, &start, &fitted)?;
    let fitted = match nearest {
        Some(nearest) => fit.finished(nearest, &fitted)?,
        None => fitted,
    };
    concluded(machine, &fit, &start, fitted, options)
}

/// The parameters that the measurements are to determine. Where R1 = r1, both keep their values: then leg I is a
/// parallelogram, which with other values no machine of this architecture has.
fn free_parameters(
    machine: &Machine,
    measurements: &Measurements,
    options: &CalibrationOptions,
) -> Vec<Parameter> {
    let is_held = |parameter: &Parameter| {
        machine.mechanism.is_delta() && matches!(parameter, Parameter::R1 | Parameter::r1)
    };
    let parameters = measurements.observed.parameters().iter().copied();
    parameters.filter(|parameter| !options.fixed.contains(parameter) && !is_held(parameter)).collect()
}

fn known(model: &Model<'_>, options: &CalibrationOptions, unknown: Unknown) -> Knowledge {
    let Some(parameter) = unknown.parameter() else { return Knowledge::default() };
    let scale = model.scale(unknown);
    let prior = options.priors.iter().find(|prior| prior.parameter == parameter);
    let prior = prior.filter(|_| options.sigma.is_some());
    let bounds = options.bounds.iter().find(|(bounded, _)| *bounded == parameter);
    Knowledge {
        prior: prior.map(|prior| [prior.value * scale, prior.sigma * scale]),
        bounds: bounds.map(|(_, bounds)| bounds.map(|bound| bound * scale)),
    }
}

/// The state, among all that fit equally, whose machine is nearest to that of the start. `None` if the measurements and
/// what is known beside them leave no choice.
fn nearest_to_start(
    fit: &Fit<'_>,
    start: &State,
    fitted: &Fitted,
) -> Result<Option<State>, CalibrationError> {
    let (model, state) = (fit.model, &fitted.state);
    let triangle = fit.triangle(state, &fit.rates(state)?, &fitted.weighting);
    let free = Fit::information(&triangle, fit.unbounded(fitted, &triangle), fitted.steps)?;
    let directions = free.null_space(model.unknowns.len());
    if directions.ncols() == 0 {
        return Ok(None);
    }
    let distance = |unknown: &Unknown| {
        let parameter = unknown.parameter()?;
        Some((start.machine.value(parameter) - state.machine.value(parameter)) * model.scale(*unknown))
    };
    let is_parameter = |row: usize| model.unknowns[row].parameter().is_some();
    let rows: Vec<usize> = (0..model.unknowns.len()).filter(|row| is_parameter(*row)).collect();
    let distances = DVector::from_iterator(rows.len(), model.unknowns.iter().filter_map(distance));
    let of_machine = directions.select_rows(&rows);
    // Without a parameter among the unknowns all of these machines are the same.
    let Some(svd) = decomposed(of_machine) else { return Ok(None) };
    let Ok(amounts) = svd.solve(&distances, LEAST_SHARE) else { return Ok(None) };
    let step = directions * amounts;
    Ok(model.moved(state, step.as_slice()).filter(|nearest| fit.is_within_bounds(nearest)))
}
