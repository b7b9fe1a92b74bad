//! `/jobs`: list, state, events and cancellation.

use std::convert::Infallible;
use std::time::Duration;

use axum::Json;
use axum::extract::State;
use axum::http::header::CACHE_CONTROL;
use axum::http::{HeaderMap, HeaderName, StatusCode};
use axum::response::sse::{Event, KeepAlive};
use axum::response::{IntoResponse, Response, Sse};
use futures_util::StreamExt;
use humantime::format_rfc3339_millis;
use verne_jobs::{Filter, Job, JobId};

use crate::http::client::Client;
use crate::http::error::{HttpError, LookupError};
use crate::http::extractors::{PathParameter, QueryString};
use crate::http::job_document::{JobList, JobObject, JobsQuery};
use crate::http::openapi::body_schemas::JobEvent;
use crate::http::openapi::problem_responses::{JobProblems, JobsProblems};
use crate::http::proxy::BasePath;
use crate::http::state::{AppState, SharedState};

/// A job changes, so no cache may store it.
const NO_STORE: (HeaderName, &str) = (CACHE_CONTROL, "no-store");

/// Makes a proxy such as nginx pass each event on immediately.
const UNBUFFERED: (HeaderName, &str) = (HeaderName::from_static("x-accel-buffering"), "no");

/// The id of the last event that the client received.
const LAST_EVENT: HeaderName = HeaderName::from_static("last-event-id");

/// The interval of comments that keep an idle stream of events open.
const KEEP_ALIVE: Duration = Duration::from_secs(15);

/// Jobs
///
/// Lists queued, running and finished jobs, newest first. A key with the role admin sees all jobs; any other key sees
/// the jobs that it requested. The service removes the records of finished jobs after a while; it stores their results
/// separately.
#[utoipa::path(
    get, path = "/jobs", operation_id = "list_jobs", tag = "jobs", params(JobsQuery),
    responses((status = 200, description = "A page of jobs.", body = JobList), JobsProblems)
)]
pub(crate) async fn get_jobs(
    State(state): State<SharedState>,
    client: Client,
    QueryString(query): QueryString<JobsQuery>,
) -> Result<impl IntoResponse, HttpError> {
    let JobsQuery { state: wanted, limit, after } = query;
    if !(1..=Filter::MAX_LIMIT).contains(&limit) {
        return Err(HttpError::field("/query/limit", "must be a number from 1 to 100"));
    }
    let after = after.map(|text| text.parse()).transpose();
    let after = after.map_err(|_| HttpError::field("/query/after", "must be the `next` of a page"))?;
    let client = client.sees_only().map(str::to_owned);
    let filter = Filter { state: wanted.map(Into::into), client, after, limit };
    let page = state.jobs.list(filter).await?;
    let jobs = page.jobs.iter().map(|job| JobObject::new(job, &state.base)).collect::<Result<_, _>>()?;
    Ok(([NO_STORE], Json(JobList { jobs, next: page.next.map(|next| next.to_string()) })))
}

/// A job
///
/// Returns the state of a job. The job has the same id as its result.
#[utoipa::path(
    get, path = "/jobs/{id}", operation_id = "get_job", tag = "jobs",
    params(("id" = String, Path, description = "The id from an answer of /workspace.")),
    responses((status = 200, description = "The job.", body = JobObject), JobProblems)
)]
pub(crate) async fn get_job(
    State(state): State<SharedState>,
    client: Client,
    PathParameter(id): PathParameter,
) -> Result<impl IntoResponse, HttpError> {
    let job = visible(&state, &client, &id).await?;
    Ok(([NO_STORE], Json(JobObject::new(&job, &state.base)?)))
}

/// Events of a job
///
/// Sends server-sent events: the job as GET /jobs/{id} returns it, immediately and after each change. The service sends
/// progress at most about ten times per second. The stream ends when the job ends; its last event is `end`, with the
/// final job. A browser's EventSource then reconnects with the id of this event; the service answers 204, and the
/// browser stops.
#[utoipa::path(
    get, path = "/jobs/{id}/events", operation_id = "get_job_events", tag = "jobs",
    params(
        ("id" = String, Path, description = "The id from an answer of /workspace."),
        ("Last-Event-ID" = Option<String>, Header, nullable = false, description =
            "The `id` of the last received event.")
    ),
    responses(
        (status = 200, description = "Events with the job as data.", content((JobEvent = "text/event-stream"))),
        (status = 204, description = "The job has ended, and Last-Event-ID is the id of its last event."),
        JobProblems
    )
)]
pub(crate) async fn get_events(
    State(state): State<SharedState>,
    client: Client,
    PathParameter(id): PathParameter,
    headers: HeaderMap,
) -> Result<Response, HttpError> {
    let job = visible(&state, &client, &id).await?;
    if job.state.is_final() && headers.get(LAST_EVENT).is_some_and(|last| *last == *event_id(&job)) {
        return Ok(([NO_STORE], StatusCode::NO_CONTENT).into_response());
    }
    let watcher = state.jobs.watch(job.id).await?.ok_or_else(|| LookupError::Job(job.id.to_string()))?;
    let stopping = state.stopping.clone().cancelled_owned();
    let permit = state.admission.streams.take(client.quota())?;
    let revoked = Box::pin(client.revoked());
    let base = state.base.clone();
    let events = watcher.take_until(stopping).take_until(revoked).flat_map(move |job| {
        // The stream has the permit until it ends.
        let _permit = &permit;
        futures_util::stream::iter(events(&job, &base).into_iter().flatten().map(Ok::<_, Infallible>))
    });
    Ok(([NO_STORE, UNBUFFERED], Sse::new(events).keep_alive(KeepAlive::new().interval(KEEP_ALIVE)))
        .into_response())
}

/// The events for a state of a job: the job and, if the state is final, the end.
fn events(job: &Job, base: &BasePath) -> Option<impl Iterator<Item = Event> + use<>> {
    let event = || Event::default().id(event_id(job)).json_data(JobObject::new(job, base).ok()?).ok();
    let end = if job.state.is_final() { Some(event()?.event("end")) } else { None };
    Some(std::iter::once(event()?).chain(end))
}

/// Identifies a state of a job. If a client requests the job again after its end, it ends at another time.
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
    delete, path = "/jobs/{id}", operation_id = "cancel_job", tag = "jobs",
    params(("id" = String, Path, description = "The id from an answer of /workspace.")),
    responses((status = 200, description = "The job.", body = JobObject), JobProblems)
)]
pub(crate) async fn delete_job(
    State(state): State<SharedState>,
    client: Client,
    PathParameter(id): PathParameter,
) -> Result<impl IntoResponse, HttpError> {
    let Job { id, .. } = visible(&state, &client, &id).await?;
    let cancelled = match client.sees_only() {
        Some(client) => state.jobs.leave(id, client).await?,
        None => state.jobs.cancel(id).await?,
    };
    let job = cancelled.ok_or_else(|| LookupError::Job(id.to_string()))?;
    Ok(([NO_STORE], Json(JobObject::new(&job, &state.base)?)))
}

/// The job, if the client sees it. The job of another client is treated like an unknown one.
async fn visible(state: &AppState, client: &Client, id: &str) -> Result<Job, HttpError> {
    let unknown = || LookupError::Job(id.to_owned());
    let id = id.parse::<JobId>().map_err(|_| unknown())?;
    let job = state.jobs.get(id).await?.filter(|job| client.sees(job));
    Ok(job.ok_or_else(unknown)?)
}
