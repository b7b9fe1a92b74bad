//! From a question to its answer: what is kept, or what a job makes while somebody waits.

use std::sync::Arc;
use std::time::Duration;

use verne_jobs::State as JobState;
use verne_jobs::{Claim, Failure, Job};

use crate::http::caller::Caller;
use crate::http::error::{HttpError, JobError};
use crate::http::state::State;
use crate::limits::admission::Place;
use crate::operations::compute_pool::run_on_pool;
use crate::operations::question::Question;
use crate::operations::question_text::JobParameters;
use crate::operations::results::Record;
use crate::wire::error::OperationError;
use crate::wire::format::MeshFormat;
use crate::wire::result_id::ResultId;
use crate::wire::role::Role;

/// What has become of a question.
pub(crate) enum Obtained<T> {
    /// The answer.
    Ready(T),
    /// A job that will have it.
    Pending(Box<Job>),
}

/// Who waits, and how long.
#[derive(Clone, Debug)]
pub(crate) struct Patience {
    /// Who waits.
    pub caller: Caller,
    /// Given back while it waits.
    pub place: Arc<Place>,
    /// How long the answer is waited for before the job's address is answered.
    pub wait: Duration,
}

impl State {
    /// The record of a question's answer.
    pub(crate) async fn obtain(
        &self,
        question: &Arc<Question>,
        patience: &Patience,
    ) -> Result<Obtained<Record>, HttpError> {
        match self.results.record(question.id()).await {
            Some(record) => Ok(Obtained::Ready(record)),
            None => self.compute(question, None, patience).await,
        }
    }

    /// Has a job compute the answer, and waits for it. The job also stores the mesh of a workspace in `mesh_format`.
    pub(crate) async fn compute(
        &self,
        question: &Arc<Question>,
        mesh_format: Option<MeshFormat>,
        patience: &Patience,
    ) -> Result<Obtained<Record>, HttpError> {
        patience.caller.must_be(Role::Compute)?;
        let (cost, max_triangles) = (self.cost(question).await?, self.limits.triangles);
        let parameters = JobParameters { max_triangles, cost, mesh_format };
        let submission =
            question.submission(parameters, patience.caller.client.clone(), Some(self.limits.job))?;
        self.results.questions.insert(Arc::clone(question));
        let claim = self.jobs.submit(submission).await.map_err(JobError::from)?;
        if patience.wait.is_zero() {
            return Ok(Obtained::Pending(kept(&claim)));
        }
        let wait = async {
            tokio::select! {
                job = claim.finished() => Ok(Some(job)),
                () = tokio::time::sleep(patience.wait) => Ok(None),
                () = self.stopping.cancelled() => {
                    // The client is told that it goes on.
                    claim.detach();
                    Err(JobError::Stopping)
                }
            }
        };
        match patience.place.aside(wait).await.unwrap_or(Ok(None))? {
            Some(job) => self.finished(question.id(), job).await.map(Obtained::Ready),
            None => Ok(Obtained::Pending(kept(&claim))),
        }
    }

    /// The estimated work of a question, seconds of one core. Equal questions at the same moment are estimated once.
    async fn cost(&self, question: &Arc<Question>) -> Result<f64, OperationError> {
        let (estimated, max_triangles) = (Arc::clone(question), self.limits.triangles);
        let estimate = run_on_pool(move |observer| estimated.cost(max_triangles, observer));
        let cost = self.costs.try_get_with(question.id().job(), estimate).await;
        cost.map_err(|error| error.as_ref().clone())
    }

    /// What `look` finds. The store may have evicted it earlier than the summary: then a job computes it again.
    pub(crate) async fn blob<T, F: Future<Output = Option<T>>>(
        &self,
        question: &Arc<Question>,
        mesh_format: Option<MeshFormat>,
        patience: &Patience,
        look: impl Fn() -> F,
    ) -> Result<Obtained<T>, HttpError> {
        if let Some(found) = look().await {
            return Ok(Obtained::Ready(found));
        }
        match self.compute(question, mesh_format, patience).await? {
            Obtained::Pending(job) => Ok(Obtained::Pending(job)),
            Obtained::Ready(_) => Ok(Obtained::Ready(look().await.ok_or(JobError::ResultTooLarge)?)),
        }
    }

    async fn finished(&self, id: ResultId, job: Job) -> Result<Record, HttpError> {
        match job.state {
            // What was just made can only be gone if there is room for nothing.
            JobState::Succeeded => Ok(self.results.record(id).await.ok_or(JobError::ResultTooLarge)?),
            JobState::Failed => Err(failure(&job)),
            JobState::Cancelled => Err(JobError::Cancelled.into()),
            JobState::Queued | JobState::Running => Err(JobError::Stopping.into()),
        }
    }
}

fn kept(claim: &Claim) -> Box<Job> {
    claim.detach();
    Box::new(claim.job())
}

/// Why a job failed.
pub(crate) fn failure(job: &Job) -> HttpError {
    match &job.failure {
        Some(Failure::Work(reason)) => {
            serde_json::from_slice(reason).unwrap_or(OperationError::Internal).into()
        }
        Some(Failure::DeadlinePassed) => JobError::DeadlinePassed.into(),
        Some(Failure::Panicked(_) | Failure::TooManyAttempts) | None => OperationError::Internal.into(),
    }
}
