//! The JSON of a job, and the response 202 with it.

use std::time::SystemTime;

use axum::Json;
use axum::http::StatusCode;
use axum::http::header::{CACHE_CONTROL, LOCATION, RETRY_AFTER};
use axum::response::{IntoResponse, Response};
use humantime::format_rfc3339_millis;
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use utoipa::{IntoParams, ToSchema};
use verne_jobs::{Failure, Job, JobId, State};

use crate::http::error::{HttpError, JobError};
use crate::http::problem::Problem;
use crate::http::proxy::BasePath;
use crate::operations::question_text::{QuestionHeader, QuestionKind};
use crate::wire::answer::MachineId;
use crate::wire::error::OperationError;
use crate::wire::result_id::ResultId;

/// A computation in the queue. It continues after its request has ended.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Job)]
pub(crate) struct JobObject {
    /// The id of the result. Equal requests share one job.
    pub id: String,
    /// The kind of result that the job computes.
    pub kind: QuestionKind,
    /// State of the job.
    #[schema(value_type = StateName)]
    pub state: &'static str,
    /// Fraction of the work that is done, 0 to 1.
    #[schema(minimum = 0, maximum = 1)]
    pub progress: f64,
    /// The request with its default values.
    #[schema(value_type = Object)]
    pub request: Box<RawValue>,
    /// The machine.
    pub machine: MachineId,
    /// Time of the request.
    #[schema(format = DateTime)]
    pub created: String,
    /// Time at which the job last started; null in the queue.
    #[schema(format = DateTime)]
    pub started: Option<String>,
    /// Time at which the job ended; null before that.
    #[schema(format = DateTime)]
    pub finished: Option<String>,
    /// Path of the result; null unless the job succeeded.
    pub result: Option<String>,
    /// The reason why the job failed; null unless it failed.
    pub error: Option<Problem>,
    /// Paths of the job.
    pub links: JobLinks,
}

/// Paths of a job.
#[derive(Debug, Serialize, ToSchema)]
pub(crate) struct JobLinks {
    /// The job; DELETE cancels it.
    #[serde(rename = "self")]
    pub itself: String,
    /// The changes of the job as server-sent events.
    pub events: String,
}

/// State of a job.
#[derive(Clone, Copy, Debug, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(as = JobState)]
pub(crate) enum StateName {
    /// The job is in the queue.
    Queued,
    /// The job is running.
    Running,
    /// The job has a result.
    Succeeded,
    /// The job ended without a result.
    Failed,
    /// A client cancelled the job, or no client waited for it any more.
    Cancelled,
}

impl From<StateName> for State {
    fn from(name: StateName) -> Self {
        match name {
            StateName::Queued => Self::Queued,
            StateName::Running => Self::Running,
            StateName::Succeeded => Self::Succeeded,
            StateName::Failed => Self::Failed,
            StateName::Cancelled => Self::Cancelled,
        }
    }
}

impl JobObject {
    /// The job, with links below the base path.
    pub(crate) fn new(job: &Job, base: &BasePath) -> Result<Self, OperationError> {
        let header = QuestionHeader::read(&job.payload).map_err(|_| OperationError::Internal)?;
        let time = |time: SystemTime| format_rfc3339_millis(time).to_string();
        let itself = format!("{base}{}", Self::path(job.id));
        Ok(Self {
            id: job.id.to_string(),
            kind: header.kind,
            state: job.state.name(),
            progress: job.progress,
            request: header.request.to_owned(),
            machine: header.machine(),
            created: time(job.created),
            started: job.started.map(time),
            finished: job.finished.map(time),
            result: (job.state == State::Succeeded)
                .then(|| format!("{base}{}", header.kind.path(ResultId::from(job.id)))),
            error: (job.state == State::Failed).then(|| Problem::from(failure(job))),
            links: JobLinks { events: format!("{itself}/events"), itself },
        })
    }

    /// The path of a job within the service.
    pub(crate) fn path(id: JobId) -> String {
        format!("/jobs/{id}")
    }
}

/// The reason why a job failed.
pub(crate) fn failure(job: &Job) -> HttpError {
    match &job.failure {
        Some(Failure::Work(reason)) => {
            serde_json::from_slice(reason).unwrap_or(OperationError::Internal).into()
        }
        Some(Failure::DeadlinePassed) => JobError::DeadlinePassed.into(),
        Some(Failure::Panicked(_) | Failure::TooManyAttempts) | None => OperationError::Internal.into(),
    }
}

/// The response 202: the job computes the result.
pub(crate) fn accepted(job: &Job, base: &BasePath) -> Result<Response, OperationError> {
    let headers = [
        (LOCATION, JobObject::path(job.id)),
        (RETRY_AFTER, "1".to_owned()),
        (CACHE_CONTROL, "no-store".to_owned()),
    ];
    Ok((StatusCode::ACCEPTED, headers, Json(JobObject::new(job, base)?)).into_response())
}

/// Jobs, newest first.
#[derive(Debug, Serialize, ToSchema)]
pub(crate) struct JobList {
    /// The jobs.
    pub jobs: Vec<JobObject>,
    /// The value of `after` for the next page; null on the last page.
    pub next: Option<String>,
}

/// Parameters of GET /jobs.
#[derive(Debug, Deserialize, IntoParams)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub(crate) struct JobsQuery {
    /// List only jobs in this state.
    #[param(inline, nullable = false)]
    pub state: Option<StateName>,
    /// Maximum number of jobs on a page.
    #[serde(default = "default_limit")]
    #[param(minimum = 1, maximum = 100, default = 50)]
    pub limit: usize,
    /// The `next` of the previous page.
    #[param(nullable = false)]
    pub after: Option<String>,
}

fn default_limit() -> usize {
    50
}
