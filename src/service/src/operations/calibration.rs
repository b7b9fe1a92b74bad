//! `/machines/calibration`: the parameters of a machine from measurements.

use std::sync::Arc;

use verne_solver::calibration::{
    Calibration, CalibrationError, CalibrationOptions, Measurements, Plan, calibrated, simulated,
};
use verne_solver::parameter::{ActualMachine, Parameter};
use verne_solver::workspace::Observer;

use crate::operations::machine_registry::IdentifiedMachine;
use crate::wire::batch::Row;
use crate::wire::calibration_answer::{
    CalibrationAnswer, CombinationObject, FrameObject, OutlierObject, ParameterEstimate,
};
use crate::wire::degrees::to_degrees;
use crate::wire::error::{FieldError, OperationError};
use crate::wire::fixed_array::FixedArray;
use crate::wire::json::write_json;
use crate::wire::machine::MachineObject;
use crate::wire::parameter::{to_wire, unit_of};

/// Most poses, and most measurements.
pub(crate) const MOST_MEASUREMENTS: usize = 20_000;

/// The end of a calibrated machine's name.
const CALIBRATED: &str = "-calibrated";
/// Most bytes of a machine's name.
const LONGEST_NAME: usize = 64;

/// About the bytes of a measurement's residual.
const RESIDUAL_BYTES: usize = 80;
/// About the bytes of the rest of an answer.
const ANSWER_BYTES: usize = 8192;

/// A checked request for a calibration.
pub(crate) struct CalibrationQuestion {
    pub(crate) machine: Arc<IdentifiedMachine>,
    pub(crate) tool_length: f64,
    pub(crate) measured: Measured,
    pub(crate) options: CalibrationOptions,
    /// Where a pose stands in the request.
    pub(crate) places: Places,
}

/// What was measured, or what is to be measured.
pub(crate) enum Measured {
    /// Measurements with their values.
    Values(Measurements),
    /// Poses without values.
    Planned(Vec<[f64; 3]>, Plan),
}

/// Where poses stand in a request.
pub(crate) enum Places {
    /// In the field `rho` of a request in JSON.
    Json,
    /// In rows of a table: the text that names the row of each pose.
    Rows(Vec<String>),
}

impl Places {
    /// The error of a pose.
    pub(crate) fn error(&self, pose: usize, detail: &str) -> FieldError {
        match self {
            Self::Json => FieldError::new(format!("/rho/{pose}"), detail),
            Self::Rows(rows) => {
                let row = rows.get(pose).map_or("", String::as_str);
                FieldError::new("/columns/rho1", format!("{row}: {detail}"))
            }
        }
    }
}

/// Answers a request, as JSON. Call it on the compute pool.
///
/// # Errors
///
/// [`OperationError::NoFit`] if the least squares have no end, [`OperationError::Fields`] for a pose at which the
/// machine cannot stand.
pub(crate) fn answer_calibration(
    question: &CalibrationQuestion,
    observer: &dyn Observer,
) -> Result<Vec<u8>, OperationError> {
    let answer = calibration_answer(question, observer)?;
    write_json(&answer, ANSWER_BYTES + RESIDUAL_BYTES * answer.residuals.len())
}

/// The same before it is written.
pub(crate) fn calibration_answer(
    question: &CalibrationQuestion,
    observer: &dyn Observer,
) -> Result<CalibrationAnswer, OperationError> {
    let CalibrationQuestion { machine, tool_length, measured, options, places } = question;
    let refused = |error| refusal(error, places);
    let calibration = |measurements: &Measurements| {
        calibrated(machine, *tool_length, measurements, options, observer).map_err(refused)
    };
    match measured {
        Measured::Values(measurements) => Ok(answer(question, calibration(measurements)?, measurements)),
        Measured::Planned(rho, plan) => {
            let exact = ActualMachine::new(machine, *tool_length);
            let measurements = simulated(&exact, rho.clone(), plan).map_err(refused)?;
            Ok(without_values(answer(question, calibration(&measurements)?, &measurements), machine))
        }
    }
}

fn refusal(error: CalibrationError, places: &Places) -> OperationError {
    match error {
        CalibrationError::NoPosture { pose, reason } => {
            let detail = format!("the machine at the start cannot stand there: {reason}");
            OperationError::Fields(vec![places.error(pose, &detail)])
        }
        CalibrationError::OutOfMode { pose } => {
            let at = places.error(pose, "not in the working mode").to_string();
            OperationError::NoFit(format!("the machine that fits best cannot stand at a measured pose, {at}"))
        }
        CalibrationError::NotConverged { steps, weakest } => {
            let names: Vec<_> = weakest.iter().map(|(unknown, _)| unknown.name()).collect();
            OperationError::NoFit(format!(
                "the least squares did not converge in {steps} steps. The measurements hardly determine {} together: \
                 fix one of them, state a prior, or measure other poses; or the start is too far off, or rows are \
                 mixed up",
                names.join(", ")
            ))
        }
        CalibrationError::Cancelled => OperationError::Cancelled,
        CalibrationError::Inconsistent(_) => OperationError::Internal,
    }
}

fn answer(
    question: &CalibrationQuestion,
    found: Calibration,
    measurements: &Measurements,
) -> CalibrationAnswer {
    let start = &question.machine;
    let offsets =
        [Parameter::o1, Parameter::o2, Parameter::o3].map(|offset| found.actual.value(offset) + 0.0);
    let components = measurements.observed.components();
    let mut machine = MachineObject::from(found.machine.data());
    machine.name = calibrated_name(start.name());
    machine.description =
        format!("Calibrated with {} measurements, from {}.", measurements.count(), start.name());
    let identified = IdentifiedMachine::new(found.machine);
    let frame = found.frame.map(|frame| {
        let ([x, y, z], [a, b, c]) = (frame.origin(), frame.angles().map(to_degrees));
        FrameObject { x, y, z, a, b, c }
    });
    let named = |combination: &verne_solver::calibration::Combination| {
        let entry = |(unknown, amount): &(verne_solver::calibration::Unknown, f64)| {
            (unknown.name(), to_wire(unknown.unit(), *amount))
        };
        CombinationObject(combination.iter().map(entry).collect())
    };
    CalibrationAnswer {
        machine,
        hash: identified.id.hash,
        start: start.id.clone(),
        slider_offsets: FixedArray(offsets),
        tool_length: found.actual.value(Parameter::ToolLength),
        parameters: found.estimates.iter().map(estimate).collect(),
        unknowns: found.singular_values.len(),
        rank: found.rank,
        singular_values: found.singular_values,
        unidentifiable: found.unidentifiable.iter().map(named).collect(),
        frame,
        centre: found.centre.map(FixedArray),
        sigma: found.sigma,
        rms: Some(found.rms),
        residuals: found
            .residuals
            .iter()
            .map(|residual| residual[..components].iter().copied().collect())
            .collect(),
        outliers: found.outliers.iter().map(outlier).collect(),
        next: found.next.iter().map(joints).collect(),
    }
}

/// The name of a calibrated machine: it can be published beside the machine with which the search began.
fn calibrated_name(start: &str) -> String {
    let is_short = start.len() + CALIBRATED.len() <= LONGEST_NAME;
    if is_short && !start.ends_with(CALIBRATED) { format!("{start}{CALIBRATED}") } else { start.to_owned() }
}

/// The answer about poses without values: what only values would tell is missing.
fn without_values(answer: CalibrationAnswer, machine: &IdentifiedMachine) -> CalibrationAnswer {
    CalibrationAnswer {
        machine: MachineObject::from(machine.data()),
        hash: machine.id.hash.clone(),
        slider_offsets: FixedArray([0.0; 3]),
        frame: None,
        centre: None,
        rms: None,
        residuals: Vec::new(),
        parameters: answer
            .parameters
            .into_iter()
            .map(|parameter| ParameterEstimate { value: parameter.start, ..parameter })
            .collect(),
        ..answer
    }
}

fn estimate(found: &verne_solver::calibration::Estimate) -> ParameterEstimate {
    let unit = found.parameter.unit();
    ParameterEstimate {
        name: found.parameter.name(),
        unit: unit_of(unit),
        start: to_wire(unit, found.start),
        value: to_wire(unit, found.value),
        sigma: found.sigma.map(|sigma| to_wire(unit, sigma)),
        identifiable: found.identifiable,
        at_bound: found.at_bound,
    }
}

fn outlier(found: &verne_solver::calibration::Outlier) -> OutlierObject {
    OutlierObject { measurement: found.measurement, residual: found.residual, ratio: found.ratio }
}

fn joints(found: &verne_solver::calibration::JointReading) -> Row {
    let table = found.table.map(|table| [table.theta1, table.theta2].map(to_degrees));
    found.rho.into_iter().chain(table.into_iter().flatten()).collect()
}
