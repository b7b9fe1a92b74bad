//! `/toolpath/window`: the values of a parameter with which the machine can run a program.

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
use crate::operations::question::Question;
use crate::operations::toolpath_request::read_fields;
use crate::operations::window_question::CheckedWindow;
use crate::wire::parse::parse_body;
use crate::wire::window::{WindowAnswer, WindowBody};

/// The values of a parameter with which the machine can run a program
///
/// Finds the intervals of the tool's length, or of a number of the set-up, in which the verdict of /toolpath is `ok`,
/// and the limit and the line that end each. The ends are those of /toolpath to 1e-6 mm or degrees: the verdict is `ok`
/// with an end itself, and `fails` with a value at most 1e-6 outside. `resolution` states how narrow intervals and gaps
/// the search may have missed.
///
/// The body has all fields of /toolpath, and `parameter`, `from` and `to`. If the computation takes longer than the
/// wait, the answer is 202 with the job. GET /toolpath/{id} returns the answer again.
#[utoipa::path(
    post, path = "/toolpath/window", operation_id = "post_window", tag = "toolpath",
    request_body(content = WindowBody, content_type = "application/json", description =
        "The program, its set-up, the parameter and its range."),
    responses(
        (status = 200, description = "The window.", body = WindowAnswer),
        (status = 202, description = "The job that computes the result. The header Location has its path.", body =
            JobObject),
        ToolpathProblems
    )
)]
pub(crate) async fn post_window(
    State(state): State<SharedState>,
    accept: Accept,
    wait_policy: WaitPolicy,
    conditions: Conditions,
    body: BatchBody,
) -> Result<Response, HttpError> {
    accept.require_json()?;
    let shared = Arc::clone(&state);
    let read = move |body: &[u8]| {
        let request: WindowBody = parse_body(body)?;
        let (mut checked, source) = read_fields(&request.toolpath, &shared.machines)?;
        let fields = CheckedWindow::new(&request.more, &mut checked)?;
        Ok((checked, source, fields))
    };
    let (checked, source, fields) = body.read(read).await?;
    let of = |toolpath| fields.question(toolpath);
    let question = about_program(&state, checked, source, of, |question| question.id).await?;
    let question = Arc::new(Question::Window(Box::new(question)));
    summary_or_job(&state, &question, &wait_policy).await?.respond(&state, wait_policy, &conditions)
}
