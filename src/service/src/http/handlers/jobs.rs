//! `/jobs`: what is being computed.

use std::convert::Infallible;
use std::time::Duration;

use axum::Json;
use axum::extract::rejection::PathRejection;
use axum::extract::{Path, State};
use axum::http::header::{CACHE_CONTROL, LOCATION, RETRY_AFTER};
use axum::http::{HeaderMap, HeaderName, StatusCode};
use axum::response::sse::{Event, KeepAlive};
use axum::response::{IntoResponse, Response, Sse};
use futures_util::StreamExt;
use humantime::format_rfc3339_millis;
use verne_jobs::{Filter, Job, JobId};

use crate::http::caller::Caller;
use crate::http::error::{HttpError, LookupError};
use crate::http::extract::Params;
use crate::http::job_document::{JobList, JobObject, JobsQuery};
use crate::http::openapi::binary::JobEvent;
use crate::http::openapi::problems::{JobProblems, JobsProblems};
use crate::http::proxy::BasePath;
use crate::http::state::Shared;

type Id = Result<Path<String>, PathRejection>;

/// A job changes: no cache may answer for it.
const LIVE: (HeaderName, &str) = (CACHE_CONTROL, "no-store");

/// A proxy, such as nginx, passes each event on at once.
const UNBUFFERED: (HeaderName, &str) = (HeaderName::from_static("x-accel-buffering"), "no");

/// The header with the id of the last event that a client has.
const LAST_EVENT: HeaderName = HeaderName::from_static("last-event-id");

/// How long an idle stream of events is silent at most.
const SILENCE: Duration = Duration::from_secs(15);

/// Jobs
///
/// Lists queued, running and finished jobs, newest first. A key with the role admin sees all jobs; any other key sees
/// the jobs that it requested. The service removes the records of finished jobs after a while; it stores their results
/// separately.
#[utoipa::path(
    get, path = "/jobs", operation_id = "jobs", tag = "jobs", params(JobsQuery),
    responses((status = 200, description = "A page of jobs.", body = JobList), JobsProblems)
)]
pub(crate) async fn get_jobs(
    State(state): State<Shared>,
    caller: Caller,
    Params(query): Params<JobsQuery>,
) -> Result<impl IntoResponse, HttpError> {
    let fault = |name, detail| HttpError::field(format!("/query/{name}"), detail);
    let JobsQuery { state: wanted, limit, after } = query;
    if !(1..=Filter::MAX_LIMIT).contains(&limit) {
        return Err(fault("limit", "must be a number from 1 to 100"));
    }
    let after = after.map(|text| text.parse().map_err(|_| fault("after", "must be the `next` of a page")));
    let client = caller.sees_only().map(str::to_owned);
    let filter = Filter { state: wanted.map(Into::into), client, after: after.transpose()?, limit };
    let page = state.jobs.list(filter).await?;
    let jobs = page.jobs.iter().map(|job| JobObject::new(job, &state.base)).collect::<Result<_, _>>()?;
    Ok(([LIVE], Json(JobList { jobs, next: page.next.map(|next| next.to_string()) })))
}

/// A job
///
/// Returns the state of a job. The job has the same id as its result.
#[utoipa::path(
    get, path = "/jobs/{id}", operation_id = "job", tag = "jobs",
    params(("id" = String, Path, description = "The id from an answer of /workspace.")),
    responses((status = 200, description = "The job.", body = JobObject), JobProblems)
)]
pub(crate) async fn get_job(
    State(state): State<Shared>,
    caller: Caller,
    id: Id,
) -> Result<impl IntoResponse, HttpError> {
    let job = visible(&state, &caller, id).await?;
    Ok(([LIVE], Json(JobObject::new(&job, &state.base)?)))
}

/// Events of a job
///
/// Sends server-sent events: the job as GET /jobs/{id} returns it, immediately and after each change. The service sends
/// progress at most about ten times per second. The stream ends when the job ends; its last event is `end`, with the
/// final job. A browser's EventSource then reconnects with the id of this event; the service answers 204, and the
/// browser stops.
#[utoipa::path(
    get, path = "/jobs/{id}/events", operation_id = "job_events", tag = "jobs",
    params(
        ("id" = String, Path, description = "The id from an answer of /workspace."),
        ("Last-Event-ID" = Option<String>, Header, nullable = false, description = "The `id` of the last received event.")
    ),
    responses(
        (status = 200, description = "Events with the job as data.", content((JobEvent = "text/event-stream"))),
        (status = 204, description = "The job has ended, and Last-Event-ID is the id of its last event."),
        JobProblems
    )
)]
pub(crate) async fn get_events(
    State(state): State<Shared>,
    caller: Caller,
    id: Id,
    headers: HeaderMap,
) -> Result<Response, HttpError> {
    let job = visible(&state, &caller, id).await?;
    if job.state.is_final() && headers.get(LAST_EVENT).is_some_and(|last| *last == *event_id(&job)) {
        return Ok(([LIVE], StatusCode::NO_CONTENT).into_response());
    }
    let watcher = state.jobs.watch(job.id).await?.ok_or_else(|| LookupError::Job(job.id.to_string()))?;
    let stopping = state.stopping.clone().cancelled_owned();
    let stream = state.admission.stream(caller.sharer())?;
    let revoked = Box::pin(caller.revoked());
    let base = state.base.clone();
    let events = watcher.take_until(stopping).take_until(revoked).flat_map(move |job| {
        // Counted until it is dropped.
        let _stream = &stream;
        futures_util::stream::iter(events(&job, &base).into_iter().flatten().map(Ok::<_, Infallible>))
    });
    Ok(([LIVE, UNBUFFERED], Sse::new(events).keep_alive(KeepAlive::new().interval(SILENCE))).into_response())
}

/// The events that tell of a job: it, and where nothing follows, the end.
fn events(job: &Job, base: &BasePath) -> Option<impl Iterator<Item = Event> + use<>> {
    let event = || Event::default().id(event_id(job)).json_data(JobObject::new(job, base).ok()?).ok();
    let end = if job.state.is_final() { Some(event()?.event("end")) } else { None };
    Some(std::iter::once(event()?).chain(end))
}

/// Tells apart how a job stood. A job that is asked for again after its end ends at another time.
fn event_id(job: &Job) -> String {
    match job.finished {
        Some(finished) => format!("{}-{}", job.state.name(), format_rfc3339_millis(finished)),
        None => format!("{}-{}", job.state.name(), job.progress),
    }
}

/// Cancel a job
///
/// Cancels the job. If other API keys requested it too, only your request is withdrawn: the job continues for them, and
/// your list of jobs no longer has it. A key with the role admin cancels the job for all. A running computation stops
/// within a second; a finished job stays unchanged. The answer is the resulting state of the job.
#[utoipa::path(
    delete, path = "/jobs/{id}", operation_id = "job_cancel", tag = "jobs",
    params(("id" = String, Path, description = "The id from an answer of /workspace.")),
    responses((status = 200, description = "The job.", body = JobObject), JobProblems)
)]
pub(crate) async fn delete_job(
    State(state): State<Shared>,
    caller: Caller,
    id: Id,
) -> Result<impl IntoResponse, HttpError> {
    let Job { id, .. } = visible(&state, &caller, id).await?;
    let ended = match caller.sees_only() {
        Some(client) => state.jobs.leave(id, client).await?,
        None => state.jobs.cancel(id).await?,
    };
    let job = ended.ok_or_else(|| LookupError::Job(id.to_string()))?;
    Ok(([LIVE], Json(JobObject::new(&job, &state.base)?)))
}

/// The job, if it is there for this caller: another's is as one that is not.
async fn visible(state: &crate::http::state::State, caller: &Caller, id: Id) -> Result<Job, HttpError> {
    let Path(text) = id.map_err(|_| HttpError::UnknownPath)?;
    let Ok(id) = text.parse::<JobId>() else { return Err(LookupError::Job(text).into()) };
    let job = state.jobs.get(id).await?.filter(|job| caller.sees(job));
    Ok(job.ok_or(LookupError::Job(text))?)
}

/// 202: a job will have the answer.
pub(crate) fn accepted(job: &Job, base: &BasePath) -> Result<Response, HttpError> {
    let object = JobObject::new(job, base)?;
    let headers =
        [(LOCATION, JobObject::path(job.id)), (RETRY_AFTER, "1".to_owned()), (LIVE.0, LIVE.1.to_owned())];
    Ok((StatusCode::ACCEPTED, headers, Json(object)).into_response())
}
