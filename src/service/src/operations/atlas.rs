//! `/atlas`: the curves on which solutions of the parallel module merge, and the regions between them, in the requested
//! format.

use verne_solver::Machine;
use verne_solver::atlas::{AtlasError, AtlasRequest, Window, atlas};
use verne_solver::workspace::Observer;

use crate::operations::drawing;
use crate::operations::machine_registry::MachineRegistry;
use crate::wire::atlas::{AtlasObject, SpaceName};
use crate::wire::atlas_query::AtlasBody;
use crate::wire::error::{FieldError, OperationError};
use crate::wire::field_errors::FieldErrors;
use crate::wire::format::SliceFormat;
use crate::wire::json::write_json;

/// About the bytes of an atlas.
const ATLAS_BYTES: usize = 512 * 1024;

/// Computes an atlas, and writes it in a format. Call it on the compute pool.
///
/// # Errors
///
/// A field is invalid; the curves lie too close together, or the solver's check of its curves failed, which is no
/// answer; the observer stopped the computation.
pub(crate) fn answer_atlas(
    body: &AtlasBody,
    machines: &MachineRegistry,
    format: SliceFormat,
    observer: &dyn Observer,
) -> Result<Vec<u8>, OperationError> {
    let machine = machines.resolve(&body.machine)?;
    let request = checked_request(body, &machine)?;
    let computed = atlas(&machine, &request, observer).map_err(|error| atlas_error(error, &machine))?;
    let answer = AtlasObject::new(machine.id.clone(), body.space, &request, computed);
    let counted = match body.space {
        SpaceName::Platform => "inverse solutions over the platform's place",
        SpaceName::Joints => "forward solutions over differences of sliders",
    };
    let title = format!("{}: {counted}", machine.id.name);
    match format {
        SliceFormat::Json => write_json(&answer, ATLAS_BYTES),
        SliceFormat::Svg => Ok(drawing::atlas::svg(&answer, &title).into_bytes()),
        SliceFormat::Dxf => Ok(drawing::atlas::dxf(&answer, &title).into_bytes()),
    }
}

/// The solver's request; every invalid field at once.
fn checked_request(body: &AtlasBody, machine: &Machine) -> Result<AtlasRequest, OperationError> {
    let space = body.space.into();
    let whole = Window::whole(machine, space);
    let mut faults = FieldErrors::default();
    let u = side(["/u_min", "/u_max"], [body.u_min, body.u_max], whole.u, machine, &mut faults);
    let v = side(["/v_min", "/v_max"], [body.v_min, body.v_max], whole.v, machine, &mut faults);
    faults.into_result()?;
    let mut request = AtlasRequest::new(machine, space, Some(Window { u, v }));
    if let Some(tolerance) = body.tolerance {
        let [finest, coarsest] = request.tolerances();
        if !(finest..=coarsest).contains(&tolerance) {
            let detail = format!("must be a number from {finest} to {coarsest} mm for this window");
            return Err(OperationError::Fields(vec![FieldError::new("/tolerance", detail)]));
        }
        request.tolerance = tolerance;
    }
    Ok(request)
}

/// The ends of a side of the window, without -0. An end that the request does not state is that of the whole plane.
fn side(
    pointers: [&str; 2],
    stated: [Option<f64>; 2],
    whole: [f64; 2],
    machine: &Machine,
    faults: &mut FieldErrors,
) -> [f64; 2] {
    let mut is_length = true;
    for (pointer, value) in pointers.into_iter().zip(stated) {
        let Some(value) = value else { continue };
        let before = faults.len();
        faults.length(pointer, value);
        if faults.len() == before {
            faults.proportion(pointer, value, machine);
        }
        is_length &= faults.len() == before;
    }
    let [low, high] = [0, 1].map(|end| stated[end].unwrap_or(whole[end]) + 0.0);
    let least = AtlasRequest::least_side(machine);
    if is_length && high - low < least {
        // The end that the request states: the other one may be the default.
        let pointer = pointers[usize::from(stated[1].is_some() || stated[0].is_none())];
        let detail = format!("gives a window from {low} to {high} mm; it must be at least {least} mm wide");
        faults.add(pointer, detail);
    }
    [low, high]
}

/// Maps an error of the solver to the field that caused it.
fn atlas_error(error: AtlasError, machine: &Machine) -> OperationError {
    let text = error.to_string();
    let fault =
        |pointer: &str, detail: String| OperationError::Fields(vec![FieldError::new(pointer, detail)]);
    match error {
        AtlasError::OutOfDomain { field: "tolerance" } => fault("/tolerance", text),
        AtlasError::OutOfDomain { field } => fault(&format!("/{field}_max"), text),
        AtlasError::Cancelled => OperationError::Cancelled,
        AtlasError::TooFine { near: Some(_) } => fault("/machine", text),
        AtlasError::TooFine { near: None } => {
            fault("/tolerance", format!("is too fine for this window: {text}"))
        }
        AtlasError::Disagreement { near: Some(_) } => fault("/machine", format!("has no atlas: {text}")),
        AtlasError::Disagreement { near: None } => {
            tracing::warn!(machine = machine.name(), "the check of an atlas failed");
            fault("/machine", format!("has no atlas of this window: {text}; another tolerance may have one"))
        }
    }
}
