//! A job as it is shown.

use std::time::SystemTime;

use humantime::format_rfc3339_millis;
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use utoipa::{IntoParams, ToSchema};
use verne_jobs::{Job, JobId, State};

use super::answer::MachineId;
use crate::answers::Gist;
use crate::config::BasePath;
use crate::error::Error;
use crate::obtain::failure;
use crate::problem::Problem;
use crate::result_id::ResultId;

/// A computation that outlives its request.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Job)]
pub(crate) struct JobObject {
    /// The id of the result: equal questions are one job.
    pub id: String,
    /// Where it stands.
    pub state: StateName,
    /// Part of the work that is done, 0 to 1.
    #[schema(minimum = 0, maximum = 1)]
    pub progress: f64,
    /// The question with its defaults.
    #[schema(value_type = Object)]
    pub request: Box<RawValue>,
    /// The machine.
    pub machine: MachineId,
    /// When it was asked for.
    #[schema(format = DateTime)]
    pub created: String,
    /// When it was last begun; null in the queue.
    #[schema(format = DateTime)]
    pub started: Option<String>,
    /// When it ended; null before.
    #[schema(format = DateTime)]
    pub finished: Option<String>,
    /// Path of the result; null until it succeeded.
    pub result: Option<String>,
    /// Why it failed; null unless it did.
    pub error: Option<Problem>,
    /// Where to follow it.
    pub links: JobLinks,
}

/// Paths of a job.
#[derive(Debug, Serialize, ToSchema)]
pub(crate) struct JobLinks {
    /// The job; DELETE cancels it.
    #[serde(rename = "self")]
    pub itself: String,
    /// Its changes as server-sent events.
    pub events: String,
}

/// Where a job stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(as = JobState)]
pub(crate) enum StateName {
    /// It waits for its turn.
    Queued,
    /// It is being computed.
    Running,
    /// Its result is there.
    Succeeded,
    /// There will be no result.
    Failed,
    /// Somebody cancelled it, or nobody waited any more.
    Cancelled,
}

impl From<State> for StateName {
    fn from(state: State) -> Self {
        match state {
            State::Queued => Self::Queued,
            State::Running => Self::Running,
            State::Succeeded => Self::Succeeded,
            State::Failed => Self::Failed,
            State::Cancelled => Self::Cancelled,
        }
    }
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
    /// The job in the contract's words, with links that begin with the path under which the service is published.
    pub(crate) fn new(job: &Job, base: &BasePath) -> Result<Self, Error> {
        let gist = Gist::of(&job.payload)?;
        let time = |time: SystemTime| format_rfc3339_millis(time).to_string();
        let itself = format!("{base}{}", Self::path(job.id));
        Ok(Self {
            id: job.id.to_string(),
            state: job.state.into(),
            progress: job.progress,
            request: gist.request.to_owned(),
            machine: gist.machine(),
            created: time(job.created),
            started: job.started.map(time),
            finished: job.finished.map(time),
            result: (job.state == State::Succeeded)
                .then(|| format!("{base}{}", ResultId::from(job.id).path())),
            error: (job.state == State::Failed).then(|| Problem::from(failure(job))),
            links: JobLinks { events: format!("{itself}/events"), itself },
        })
    }

    /// The path of a job within the service.
    pub(crate) fn path(id: JobId) -> String {
        format!("/jobs/{id}")
    }
}

/// Jobs, newest first.
#[derive(Debug, Serialize, ToSchema)]
pub(crate) struct JobList {
    /// The jobs.
    pub jobs: Vec<JobObject>,
    /// What `after` takes for the next page; null on the last.
    pub next: Option<String>,
}

/// Parameters of GET /jobs.
#[derive(Debug, Deserialize, IntoParams)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub(crate) struct JobsQuery {
    /// Only jobs in this state.
    #[param(inline, nullable = false)]
    pub state: Option<StateName>,
    /// Most jobs on a page.
    #[serde(default = "default_limit")]
    #[param(minimum = 1, maximum = 100, default = 50)]
    pub limit: usize,
    /// Where the last page ended: its `next`.
    #[param(nullable = false)]
    pub after: Option<String>,
}

fn default_limit() -> usize {
    50
}
