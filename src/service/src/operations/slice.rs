//! Slices: cuts of a workspace at one height, in the requested format.

use verne_solver::workspace::{Observer, Request, slice};

use crate::operations::drawing;
use crate::operations::solver_errors::workspace_error;
use crate::operations::workspace_question::WorkspaceQuestion;
use crate::wire::alphas::Alphas;
use crate::wire::degrees::{from_degrees, to_degrees};
use crate::wire::error::OperationError;
use crate::wire::field_errors::FieldErrors;
use crate::wire::format::SliceFormat;
use crate::wire::json::write_json;
use crate::wire::slice::SliceObject;

/// Degrees between two lines of constant alpha if the request does not list them.
const STEP: f64 = 5.0;

/// About the bytes of a slice.
const SLICE_BYTES: usize = 16 * 1024;

/// Cuts a workspace. `inclination` is its greatest |alpha|, rad. Call it on the compute pool.
pub(crate) fn answer_slice(
    question: &WorkspaceQuestion,
    inclination: Option<f64>,
    z: f64,
    alphas: &Alphas,
    format: SliceFormat,
    observer: &dyn Observer,
) -> Result<Vec<u8>, OperationError> {
    let mut faults = FieldErrors::default();
    faults.length("/z", z);
    faults.into_result()?;
    let alphas = angles(alphas, inclination);
    let (request, z) = (Request::from(&question.request), z + 0.0);
    let cut = slice(&question.machine, &request, z, &alphas, observer).map_err(workspace_error)?;
    let cut = SliceObject::new(question.id, &question.request, z, cut);
    let title =
        format!("{}: {} workspace at z = {z} mm", question.machine.id.name, question.request.kind.name());
    match format {
        SliceFormat::Json => write_json(&cut, SLICE_BYTES),
        SliceFormat::Svg => Ok(drawing::slice::svg(&cut, &title).into_bytes()),
        SliceFormat::Dxf => Ok(drawing::slice::dxf(&cut, &title).into_bytes()),
    }
}

/// The requested lines, rad.
fn angles(alphas: &Alphas, most: Option<f64>) -> Vec<f64> {
    match alphas {
        Alphas::None => Vec::new(),
        Alphas::List(degrees) => degrees.iter().copied().map(from_degrees).collect(),
        Alphas::EqualSteps => {
            let most = to_degrees(most.unwrap_or_default());
            let positive = (1..).map(|i| STEP * f64::from(i)).take_while(|angle| *angle < most);
            let mut degrees: Vec<f64> = positive.flat_map(|angle| [-angle, angle]).chain([0.0]).collect();
            degrees.sort_by(f64::total_cmp);
            degrees.into_iter().map(from_degrees).collect()
        }
    }
}
