//! `/machines/calibration`.

use axum::extract::{FromRequest, Request, State};
use axum::http::HeaderMap;
use axum::http::header::CONTENT_TYPE;
use axum::response::{IntoResponse, Response};
use verne_rows::Format;

use crate::http::error::HttpError;
use crate::http::extractors::{BatchBody, QueryString, is_json};
use crate::http::openapi::body_schemas::{Binary, Text};
use crate::http::openapi::problem_responses::CalibrationProblems;
use crate::http::row_stream::refuse_parameters;
use crate::http::state::SharedState;
use crate::operations::calibration::answer_calibration;
use crate::operations::calibration_request::read_calibration;
use crate::operations::calibration_table::CalibrationTable;
use crate::wire::calibration::CalibrationRequest;
use crate::wire::calibration_answer::CalibrationAnswer;
use crate::wire::calibration_query::CalibrationQuery;
use crate::wire::error::OperationError;
use crate::wire::machine_ref::MachineRef;
use crate::wire::query::point_into_query;
use crate::wire::row_format::RowFormat;

/// Calibrate a machine
///
/// Determines the dimensions of a machine, the zero offsets of its sliders and the length of the tool from
/// measurements, by least squares. The answer has the machine, ready for requests; the standard deviation of each
/// parameter; the combinations that the measurements do not determine, by name; outliers; and the poses to measure
/// next. Without measured values it says what the poses would identify. The model takes the rods of each leg as equal.
///
/// Instead of JSON the body may be a table: a stream of Apache Arrow, CSV or NDJSON with the columns rho1, rho2, rho3
/// and x, y, z (with kind `part` theta1, theta2, too), length (`ballbar`), or to_rho1, to_rho2, to_rho3 and distance
/// (`distances`); the query then has what is not a measurement.
#[utoipa::path(
    post, path = "/machines/calibration", operation_id = "post_calibration", tag = "machines",
    params(CalibrationQuery),
    request_body(description = "The measurements.", content(
        (CalibrationRequest = "application/json"), (Binary = "application/vnd.apache.arrow.stream"),
        (Text = "text/csv"), (Text = "application/x-ndjson"),
    )),
    responses((status = 200, description = "The machine that fits the measurements.", body = CalibrationAnswer),
        CalibrationProblems)
)]
pub(crate) async fn post_calibration(
    State(state): State<SharedState>,
    QueryString(query): QueryString<CalibrationQuery>,
    request: Request,
) -> Result<Response, HttpError> {
    let max_rows = state.limits.rows;
    let answer = if let Some(format) = table_format(request.headers(), query.format)? {
        let machine = MachineRef::of_parameter(&query.machine).map_err(in_query)?;
        let table = CalibrationTable::new(&query.into_request(machine), &state.machines).map_err(in_query)?;
        let body = BatchBody::of_any_media(request, &state).await?;
        body.answer(move |body, observer| answer_calibration(&table.read(format, body, max_rows)?, observer))
            .await?
    } else {
        refuse_parameters(&request)?;
        let body = BatchBody::from_request(request, &state).await?;
        body.answer(move |body, observer| {
            answer_calibration(&read_calibration(body, &state.machines, max_rows)?, observer)
        })
        .await?
    };
    Ok(([(CONTENT_TYPE, "application/json")], answer).into_response())
}

fn in_query(error: OperationError) -> HttpError {
    point_into_query(error).into()
}

/// The format of a table; `None` for a JSON document.
fn table_format(headers: &HeaderMap, stated: Option<RowFormat>) -> Result<Option<Format>, HttpError> {
    let declared = headers.get(CONTENT_TYPE).and_then(|value| value.to_str().ok()).unwrap_or_default();
    let stated = stated.and_then(RowFormat::columns);
    match (is_json(declared), stated) {
        (true, Some(_)) => Err(HttpError::field("/query/format", "must be json: the body is JSON")),
        (true, None) => Ok(None),
        (false, _) => Ok(Format::of_media(declared).or(stated)),
    }
}
