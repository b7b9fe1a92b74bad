//! From a question to its answer: what is kept, or what a job makes while somebody waits.

use std::sync::Arc;
use std::time::Duration;

use verne_jobs::State as JobState;
use verne_jobs::{Claim, Failure, Job};

use crate::http::caller::Caller;
use crate::http::error::{HttpError, JobError};
use crate::http::state::State;
use crate::limits::admission::Place;
use crate::operations::compute_pool::on_workers_while_waited_for;
use crate::operations::question::{Question, TaskFault, Terms};
use crate::operations::results::Record;
use crate::wire::error::OperationError;
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
        question: &Question,
        patience: &Patience,
    ) -> Result<Obtained<Record>, HttpError> {
        let id = question.id();
        match self.results.record(id).await {
            Some(record) => Ok(Obtained::Ready(record)),
            None => self.compute(question, patience).await,
        }
    }

    /// Has a job compute the answer, and waits for it.
    pub(crate) async fn compute(
        &self,
        question: &Question,
        patience: &Patience,
    ) -> Result<Obtained<Record>, HttpError> {
        patience.caller.must_be(Role::Compute)?;
        let terms = self.terms(question).await?;
        let submission = question.submission(terms, patience.caller.client.clone(), Some(self.limits.job))?;
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

    /// On which terms a job may answer. Of equal questions at the same moment one is estimated.
    async fn terms(&self, question: &Question) -> Result<Terms, OperationError> {
        let (asked, most) = (question.clone(), self.limits.triangles);
        let estimate = on_workers_while_waited_for(move |observer| asked.terms(most, observer));
        let terms = self.terms.try_get_with(question.id().job(), estimate).await;
        terms.map_err(|error| error.as_ref().clone())
    }

    /// What a look at a part of a question's answer finds. It may have left the store before the figures did: then a
    /// job computes it again.
    pub(crate) async fn part<T, F: Future<Output = Option<T>>>(
        &self,
        question: &Question,
        patience: &Patience,
        look: impl Fn() -> F,
    ) -> Result<Obtained<T>, HttpError> {
        if let Some(part) = look().await {
            return Ok(Obtained::Ready(part));
        }
        match self.compute(question, patience).await? {
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
        Some(Failure::Work(fault)) => serde_json::from_slice::<TaskFault>(fault)
            .map_or(OperationError::Internal, OperationError::from)
            .into(),
        Some(Failure::DeadlinePassed) => JobError::DeadlinePassed.into(),
        Some(Failure::Panicked(_) | Failure::TooManyAttempts) | None => OperationError::Internal.into(),
    }
}
