//! Decides whether a response is 200 with a result or 202 with a job.
//!
//! A result that is stored is sent at once. Otherwise a job computes it; the request waits for the job as its
//! [`WaitPolicy`] says. If the wait is over first, the response is 202 with the address of the job.

use std::sync::Arc;

use axum::response::Response;
use verne_jobs::State as JobState;
use verne_jobs::{Claim, Job};

use crate::http::conditional_response::{Conditions, Representation};
use crate::http::error::{HttpError, JobError};
use crate::http::job_document::{accepted, failure};
use crate::http::state::AppState;
use crate::http::wait_policy::WaitPolicy;
use crate::operations::compute_pool::run_on_pool;
use crate::operations::question::Question;
use crate::operations::question_text::JobParameters;
use crate::operations::results::Record;
use crate::wire::error::OperationError;
use crate::wire::format::MeshFormat;
use crate::wire::result_id::ResultId;
use crate::wire::role::Role;

/// A result, or the job that computes it.
pub(crate) enum ResultOrJob<T> {
    /// The result: 200.
    Result(T),
    /// The job: 202.
    Job(Box<Job>),
}

impl<T> ResultOrJob<T> {
    /// Applies a function to the result.
    pub(crate) fn map<U>(self, function: impl FnOnce(T) -> U) -> ResultOrJob<U> {
        match self {
            Self::Result(result) => ResultOrJob::Result(function(result)),
            Self::Job(job) => ResultOrJob::Job(job),
        }
    }
}

impl ResultOrJob<Representation> {
    /// The response: 200 (or 206 or 304) with the result, or 202 with the job.
    pub(crate) fn respond(
        self,
        state: &AppState,
        wait_policy: WaitPolicy,
        conditions: &Conditions,
    ) -> Result<Response, HttpError> {
        let mut response = match self {
            Self::Result(representation) => representation.respond(conditions)?,
            Self::Job(job) => accepted(&job, &state.base)?,
        };
        wait_policy.state_preference(&mut response);
        Ok(response)
    }
}

impl AppState {
    /// The record of a question's result, or the job that computes it.
    pub(crate) async fn record_or_job(
        &self,
        question: &Arc<Question>,
        wait_policy: &WaitPolicy,
    ) -> Result<ResultOrJob<Record>, HttpError> {
        match self.results.record(question.id()).await {
            Some(record) => Ok(ResultOrJob::Result(record)),
            None => self.compute(question, None, wait_policy).await,
        }
    }

    /// A blob of a question's result, which `find` looks up, or the job that computes it. The store may have evicted
    /// the blob before the record.
    pub(crate) async fn blob_or_job<T, F: Future<Output = Option<T>>>(
        &self,
        question: &Arc<Question>,
        wait_policy: &WaitPolicy,
        mesh_format: Option<MeshFormat>,
        find: impl Fn() -> F,
    ) -> Result<ResultOrJob<T>, HttpError> {
        if let Some(blob) = find().await {
            return Ok(ResultOrJob::Result(blob));
        }
        match self.compute(question, mesh_format, wait_policy).await? {
            ResultOrJob::Job(job) => Ok(ResultOrJob::Job(job)),
            ResultOrJob::Result(_) => Ok(ResultOrJob::Result(find().await.ok_or(JobError::ResultTooLarge)?)),
        }
    }

    /// Submits a job, and waits for it. The job also stores the mesh of a workspace in `mesh_format`.
    async fn compute(
        &self,
        question: &Arc<Question>,
        mesh_format: Option<MeshFormat>,
        wait_policy: &WaitPolicy,
    ) -> Result<ResultOrJob<Record>, HttpError> {
        let client = &wait_policy.client;
        client.require(Role::Compute)?;
        let (cost, max_triangles) = (self.cost(question).await?, self.limits.triangles);
        let parameters = JobParameters { max_triangles, cost, mesh_format };
        let submission = question.submission(parameters, client.name.clone(), Some(self.limits.job))?;
        self.results.questions.insert(Arc::clone(question));
        let claim = self.jobs.submit(submission).await.map_err(JobError::from)?;
        let longest = wait_policy.wait();
        if longest.is_zero() {
            return Ok(ResultOrJob::Job(detach(&claim)));
        }
        let wait = async {
            tokio::select! {
                job = claim.finished() => Ok(Some(job)),
                () = tokio::time::sleep(longest) => Ok(None),
                () = self.stopping.cancelled() => {
                    // The response says that the job continues after the next start.
                    claim.detach();
                    Err(JobError::Stopping)
                }
            }
        };
        // `None`: too many requests wait already.
        match wait_policy.permit.return_during(wait).await.unwrap_or(Ok(None))? {
            Some(job) => self.record_of(question.id(), job).await.map(ResultOrJob::Result),
            None => Ok(ResultOrJob::Job(detach(&claim))),
        }
    }

    /// The estimated work of a question, seconds of one core. Equal questions at the same moment share one estimate.
    async fn cost(&self, question: &Arc<Question>) -> Result<f64, OperationError> {
        let (estimated, max_triangles) = (Arc::clone(question), self.limits.triangles);
        let estimate = run_on_pool(move |observer| estimated.cost(max_triangles, observer));
        let cost = self.costs.try_get_with(question.id().job(), estimate).await;
        cost.map_err(|error| error.as_ref().clone())
    }

    /// The record that a finished job stored.
    async fn record_of(&self, id: ResultId, job: Job) -> Result<Record, HttpError> {
        match job.state {
            // A fresh result is missing only if the store has no room for it.
            JobState::Succeeded => Ok(self.results.record(id).await.ok_or(JobError::ResultTooLarge)?),
            JobState::Failed => Err(failure(&job)),
            JobState::Cancelled => Err(JobError::Cancelled.into()),
            JobState::Queued | JobState::Running => Err(JobError::Stopping.into()),
        }
    }
}

/// The job of a claim, which continues when its request ends.
fn detach(claim: &Claim) -> Box<Job> {
    claim.detach();
    Box::new(claim.job())
}
