//! `/error-budget`, `/workspace/error-budget` and the points of its map.

use std::sync::Arc;

use axum::extract::{Request, State};
use axum::response::Response;

use crate::http::client::Client;
use crate::http::conditional_response::Conditions;
use crate::http::error::HttpError;
use crate::http::extractors::{JsonBody, QueryString};
use crate::http::handlers::batch::{document, in_query, json};
use crate::http::job_document::JobObject;
use crate::http::negotiation::Accept;
use crate::http::openapi::body_schemas::{Binary, Text};
use crate::http::openapi::problem_responses::{BatchProblems, ErrorMapProblems};
use crate::http::result_representation::summary_or_job;
use crate::http::row_stream::{answer_rows, formats};
use crate::http::state::SharedState;
use crate::http::wait_policy::WaitPolicy;
use crate::operations::error_budget::answer_error_budget;
use crate::operations::error_budget_columns::ErrorBudgetColumns;
use crate::operations::error_map_question::ErrorMapQuestion;
use crate::operations::question::Question;
use crate::wire::error_budget::{ErrorBudgetAnswer, ErrorBudgetNumbers, ErrorBudgetRowsQuery};
use crate::wire::error_map::{ErrorMapBody, ErrorMapSummary};
use crate::wire::machine_ref::MachineRef;

/// Error budget
///
/// Computes, for tolerances of the machine's parameters, how far the tool end and the tool's axis may be off at each
/// pose: the root mean square for independent parameters, the greatest error with every parameter within its tolerance,
/// and what each parameter contributes. The figures are of the first order; `worst_exact` is that of the exact model
/// with the worst parameters. The model takes the rods of a leg as equal; it has no deflection and no temperature.
///
/// Instead of JSON the body may be a stream of Apache Arrow, CSV or NDJSON, with the columns x, y, z and phi1, phi2 or
/// i, j, k in any order; the query then has what is not a row. The service answers rows while later rows arrive, and
/// any number of them. Other columns are passed on; a column of the answer replaces one of its name.
#[utoipa::path(
    post, path = "/error-budget", operation_id = "post_error_budget", tag = "kinematics",
    params(ErrorBudgetRowsQuery),
    request_body(description = "The tolerances and the poses.", content(
        (ErrorBudgetNumbers = "application/json"), (Binary = "application/vnd.apache.arrow.stream"),
        (Text = "text/csv"), (Text = "application/x-ndjson"),
    )),
    responses((status = 200, description = "One entry for each row.", content(
        (ErrorBudgetAnswer = "application/json"), (Binary = "application/vnd.apache.arrow.stream"),
        (Text = "text/csv"), (Text = "application/x-ndjson"),
    )), BatchProblems)
)]
pub(crate) async fn post_error_budget(
    State(state): State<SharedState>,
    client: Client,
    accept: Accept,
    QueryString(query): QueryString<ErrorBudgetRowsQuery>,
    request: Request,
) -> Result<Response, HttpError> {
    if let Some(formats) = formats(request.headers(), query.format, &accept)? {
        let machine = MachineRef::of_parameter(&query.machine).map_err(in_query)?;
        let rowless = query.into_request(machine).map_err(in_query)?;
        let answer = ErrorBudgetColumns::new(&rowless, &state.machines).map_err(in_query)?;
        return answer_rows(&state, client, request, formats, Box::new(answer)).await;
    }
    let batch = document(request, &state).await?;
    let answer = batch.answer(move |body, observer| {
        answer_error_budget(body, &state.machines, state.limits.rows, observer)
    });
    answer.await.map(json)
}

/// Error map of a workspace
///
/// Computes the error budget at each point of a grid inside a workspace and at the vertices of its surface, and the
/// largest errors that it finds. GET /workspace/{id}/cells has the points. GET /workspace/{id}/mesh has the surface,
/// coloured in bands of one of the errors, which `error` selects. The job takes long; with `Prefer: respond-async` the
/// service returns its address immediately.
#[utoipa::path(
    post, path = "/workspace/error-budget", operation_id = "post_error_map", tag = "workspace",
    request_body(content = ErrorMapBody, description = "The workspace, the grid and the tolerances."),
    responses(
        (status = 200, description = "The summary of the map.", body = ErrorMapSummary),
        (status = 202, description = "The job that computes the result. The header Location has its path.", body =
            JobObject),
        ErrorMapProblems
    )
)]
pub(crate) async fn post_error_map(
    State(state): State<SharedState>,
    accept: Accept,
    wait_policy: WaitPolicy,
    conditions: Conditions,
    JsonBody(body): JsonBody<ErrorMapBody>,
) -> Result<Response, HttpError> {
    accept.require_json()?;
    let question = ErrorMapQuestion::new(&body, &state.machines)?;
    let question = Arc::new(Question::ErrorMap(Box::new(question)));
    let summary = summary_or_job(&state, &question, &wait_policy).await?;
    summary.respond(&state, wait_policy, &conditions)
}
