//! Checks what a request for a calibration has beside its measurements.

use verne_solver::calibration::{CalibrationOptions, Observed, Plan, Prior};
use verne_solver::parameter::{ActualMachine, Parameter, ParameterUnit};

use crate::operations::calibration::{CalibrationQuestion, Measured, Places};
use crate::operations::machine_registry::MachineRegistry;
use crate::wire::calibration::{CalibrationRequest, MOST_NEXT, MeasurementKind};
use crate::wire::error::OperationError;
use crate::wire::field_errors::FieldErrors;
use crate::wire::fixed_array::Pair;
use crate::wire::parameter::{of_wire, to_wire};

/// The least and the greatest standard deviation, in the unit of the API.
const SIGMAS: [f64; 2] = [1e-9, 1e6];

/// The question with a checked machine and options and without measurements, and the faults so far.
///
/// # Errors
///
/// The machine cannot be used.
pub(crate) fn without_measurements(
    request: &CalibrationRequest,
    machines: &MachineRegistry,
) -> Result<(CalibrationQuestion, FieldErrors), OperationError> {
    let machine = machines.resolve(&request.machine)?;
    let mut faults = FieldErrors::default();
    faults.tool_length(request.tool_length);
    faults.proportion("/tool_length", request.tool_length, &machine);
    if let Some(centre) = request.centre {
        if request.kind == MeasurementKind::Ballbar {
            faults.point("/centre", &centre.0, &machine);
        } else {
            faults.add("/centre", "only kind `ballbar` has it");
        }
    }
    if request.next > MOST_NEXT {
        faults.add("/next", format!("must be a number from 0 to {MOST_NEXT}"));
    }
    check_sigma("/sigma", request.sigma, &mut faults);
    let start = ActualMachine::new(&machine, request.tool_length);
    let options = options(request, &start, &mut faults);
    let measured = Measured::Planned(Vec::new(), Plan::Tips);
    let question = CalibrationQuestion {
        machine,
        tool_length: request.tool_length + 0.0,
        measured,
        options,
        places: Places::Json,
    };
    Ok((question, faults))
}

fn options(
    request: &CalibrationRequest,
    start: &ActualMachine,
    faults: &mut FieldErrors,
) -> CalibrationOptions {
    check_names(request, faults);
    if !request.priors.is_empty() && request.sigma.is_none() {
        faults.add("/sigma", "is missing: priors are weighed against the accuracy of the measurements");
    }
    let priors = request.priors.iter().map(|(name, prior)| {
        let (parameter, pointer) = (name.0, format!("/priors/{}", name.0.name()));
        check_sigma(&format!("{pointer}/sigma"), Some(prior.0.sigma), faults);
        let value = prior.0.value.map(|value| {
            if !value.is_finite() || value.abs() > SIGMAS[1] {
                faults.add(format!("{pointer}/value"), format!("must be a number within ±{:e}", SIGMAS[1]));
            }
            of_wire(parameter.unit(), value)
        });
        let value = value.unwrap_or_else(|| start.value(parameter));
        Prior { parameter, value, sigma: of_wire(parameter.unit(), prior.0.sigma) }
    });
    let priors = priors.collect();
    let bounds = request.bounds.iter().map(|(name, range)| {
        check_bounds(name.0, *range, start, faults);
        (name.0, range.0.map(|bound| of_wire(name.0.unit(), bound)))
    });
    let bounds = bounds.collect();
    CalibrationOptions {
        fixed: request.fixed.iter().map(|name| name.0).collect(),
        priors,
        bounds,
        sigma: request.sigma,
        loss: request.loss.into(),
        next: usize::try_from(request.next).unwrap_or_default(),
    }
}

/// Refuses parameters on which the kind does not depend, and knowledge of parameters that keep their values.
fn check_names(request: &CalibrationRequest, faults: &mut FieldErrors) {
    let parameters = kind_of(request.kind).parameters();
    let priors = request.priors.keys().map(|name| (format!("/priors/{}", name.0.name()), name));
    let bounds = request.bounds.keys().map(|name| (format!("/bounds/{}", name.0.name()), name));
    let fixed = request.fixed.iter().enumerate().map(|(i, name)| (format!("/fixed/{i}"), name));
    for (pointer, name) in fixed.chain(priors.clone()).chain(bounds.clone()) {
        if !parameters.contains(&name.0) {
            faults.add(pointer, format!("kind `{}` does not depend on it", request.kind.name()));
        }
    }
    for (pointer, _) in priors.chain(bounds).filter(|(_, name)| request.fixed.contains(name)) {
        faults.add(pointer, "cannot be used: the parameter is in `fixed`");
    }
}

fn check_bounds(parameter: Parameter, range: Pair, start: &ActualMachine, faults: &mut FieldErrors) {
    let [low, high] = range.0;
    let value = to_wire(parameter.unit(), start.value(parameter));
    if !(low <= value && value <= high && low < high) {
        let unit = if parameter.unit() == ParameterUnit::Radian { "degrees" } else { "mm" };
        let detail = format!("must be [least, greatest] around the value at the start, {value} {unit}");
        faults.add(format!("/bounds/{}", parameter.name()), detail);
    }
}

fn check_sigma(pointer: &str, sigma: Option<f64>, faults: &mut FieldErrors) {
    let [least, most] = SIGMAS;
    if sigma.is_some_and(|sigma| !(least..=most).contains(&sigma)) {
        faults.add(pointer, format!("must be a number from {least:e} to {most:e}"));
    }
}

/// What a kind depends on.
fn kind_of(kind: MeasurementKind) -> Observed {
    match kind {
        MeasurementKind::Tips => Observed::Tips(Vec::new()),
        MeasurementKind::Tracker => Observed::TrackerTips(Vec::new()),
        MeasurementKind::Part => Observed::PartTips(Vec::new()),
        MeasurementKind::Distances => Observed::Distances(Vec::new()),
        MeasurementKind::Ballbar => Observed::BallBar { centre: None, lengths: Vec::new() },
    }
}
