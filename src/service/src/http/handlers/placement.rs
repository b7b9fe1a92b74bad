//! `/toolpath/placement`: the set-up with the greatest reserve.

use std::sync::Arc;

use axum::extract::State;
use axum::response::Response;

use crate::http::conditional_response::Conditions;
use crate::http::error::HttpError;
use crate::http::extractors::BatchBody;
use crate::http::handlers::toolpath::about_program;
use crate::http::job_document::JobObject;
use crate::http::negotiation::Accept;
use crate::http::openapi::problem_responses::ToolpathProblems;
use crate::http::result_representation::summary_or_job;
use crate::http::state::SharedState;
use crate::http::wait_policy::WaitPolicy;
use crate::operations::placement_question::CheckedPlacement;
use crate::operations::question::Question;
use crate::operations::toolpath_request::read_fields;
use crate::wire::parse::parse_body;
use crate::wire::placement::{PlacementAnswer, PlacementBody};

/// The set-up in which a program keeps the greatest distance from the limits
///
/// Finds the values of the free parameters within their bounds that maximise t, where every margin in `reserve` is at
/// least t times its reserve, and every other margin at least zero. The service searches from many set-ups, and plans
/// the program in the best ones: t and `margins` are those of /toolpath with the answer's `setup` and `tool_length`,
/// and so is the verdict. The answer is never worse than the given set-up if that is within the bounds.
///
/// The body has all fields of /toolpath, and `free` and `reserve`. If the computation takes longer than the wait, the
/// answer is 202 with the job. GET /toolpath/{id} returns the answer again.
#[utoipa::path(
    post, path = "/toolpath/placement", operation_id = "post_placement", tag = "toolpath",
    request_body(content = PlacementBody, content_type = "application/json", description =
        "The program, the given set-up, the free parameters and the reserve."),
    responses(
        (status = 200, description = "The placement.", body = PlacementAnswer),
        (status = 202, description = "The job that computes the result. The header Location has its path.", body =
            JobObject),
        ToolpathProblems
    )
)]
pub(crate) async fn post_placement(
    State(state): State<SharedState>,
    accept: Accept,
    wait_policy: WaitPolicy,
    conditions: Conditions,
    body: BatchBody,
) -> Result<Response, HttpError> {
    accept.require_json()?;
    let shared = Arc::clone(&state);
    let read = move |body: &[u8]| {
        let request: PlacementBody = parse_body(body)?;
        let (checked, source) = read_fields(&request.toolpath, &shared.machines)?;
        let fields = CheckedPlacement::new(&request.more, &checked)?;
        Ok((checked, source, fields))
    };
    let (checked, source, fields) = body.read(read).await?;
    let of = |toolpath| fields.question(toolpath);
    let question = about_program(&state, checked, source, of, |question| question.id).await?;
    let question = Arc::new(Question::Placement(Box::new(question)));
    summary_or_job(&state, &question, &wait_policy).await?.respond(&state, wait_policy, &conditions)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests;
