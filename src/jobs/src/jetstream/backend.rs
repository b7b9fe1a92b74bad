//! A process's connection to the jobs at a broker.

use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

use async_nats::connection::State;
use async_trait::async_trait;
use tokio::sync::{mpsc, watch};
use tokio::task::JoinSet;
use tokio::time::timeout;

use super::claim_recorder::{JetStreamClaim, record_claims};
use super::client::Client;
use super::config::{Config, ConnectError};
use super::nats::Nats;
use super::record::Claimant;
use super::{dead_letter, heartbeat, reaper, subscriptions};
use crate::backend::Backend;
use crate::claim::Claim;
use crate::counts::Counts;
use crate::error::{SubmitError, UnavailableError};
use crate::job::{Job, Submission};
use crate::job_id::JobId;
use crate::job_watch::Watcher;
use crate::page::{Filter, Page};

/// Longest time to read all records at the start.
const CATCH_UP_TIMEOUT: Duration = Duration::from_secs(30);

/// Longest time to record changes of claims.
const CLAIMS_TIMEOUT: Duration = Duration::from_secs(5);

/// A process's connection to the jobs of all processes at a broker.
pub struct JetStream {
    pub(super) client: Arc<Client>,
    /// Aborted when this is dropped.
    tasks: parking_lot::Mutex<JoinSet<()>>,
}

impl JetStream {
    /// Connects, creates streams and consumers that are missing, and reads the records.
    ///
    /// # Errors
    ///
    /// A setting is unusable, or the broker refuses the process or does not answer.
    pub async fn connect(config: Config) -> Result<Self, ConnectError> {
        let nats = Box::pin(Nats::connect(config)).await?;
        let (sender, changes) = mpsc::unbounded_channel();
        let client = Arc::new(Client::new(nats, sender));
        let (sender, mut caught_up) = watch::channel(false);
        let mut tasks = JoinSet::new();
        tasks.spawn(subscriptions::receive_records(Arc::clone(&client), sender));
        tasks.spawn(subscriptions::receive_progress(Arc::clone(&client)));
        tasks.spawn(record_claims(Arc::clone(&client), changes));
        let late = || ConnectError::Broker("the records of jobs cannot be read".to_owned());
        let read = timeout(CATCH_UP_TIMEOUT, caught_up.wait_for(|done| *done)).await.map_err(|_| late())?;
        drop(read.map_err(|_| late())?);
        tasks.spawn(reaper::run_maintenance(Arc::clone(&client)));
        tasks.spawn(heartbeat::send_heartbeats(Arc::clone(&client)));
        tasks.spawn(dead_letter::fail_undeliverable(Arc::clone(&client)));
        let checking = Arc::clone(&client);
        tasks.spawn(async move { checking.nats.watch_permissions().await });
        Ok(Self { client, tasks: parking_lot::Mutex::new(tasks) })
    }

    /// Waits until the claims that were dropped before are recorded.
    async fn claims_recorded(&self) -> Result<(), UnavailableError> {
        if self.client.closed.load(Ordering::Acquire) {
            return Err(UnavailableError::closed());
        }
        let late = |_| UnavailableError::new("the broker does not answer");
        timeout(CLAIMS_TIMEOUT, self.client.claims.recorded()).await.map_err(late)
    }

    /// Waits until the job is in the replica, if it exists: another process may have just submitted it.
    async fn up_to_date(&self, id: JobId) -> Result<(), UnavailableError> {
        self.claims_recorded().await?;
        if self.client.replica.revision(id).is_none() {
            self.client.refresh(id).await?;
        }
        Ok(())
    }
}

async fn submit(client: Arc<Client>, submission: Submission) -> Result<Claim, SubmitError> {
    let _shard = client.shard(submission.id).await;
    let class = client.nats.config.class(submission.cost);
    let record = client.submit(&submission, Claimant::Process(client.process), class).await?;
    let guard = JetStreamClaim::new(&client, record.key());
    let job = client.replica.subscribe_to(record.key());
    let job = job.ok_or_else(|| UnavailableError::new("another process has started the job again"))?;
    Ok(Claim::new(job, Box::new(guard)))
}

#[async_trait]
impl Backend for JetStream {
    async fn submit(&self, submission: Submission) -> Result<Claim, SubmitError> {
        // In a task of its own: if the caller drops this future, the claim is dropped too and does not stay in the
        // record.
        let submitted = tokio::spawn(submit(Arc::clone(&self.client), submission));
        submitted.await.unwrap_or_else(|error| Err(UnavailableError::new(error).into()))
    }

    async fn get(&self, id: JobId) -> Result<Option<Job>, UnavailableError> {
        self.up_to_date(id).await?;
        Ok(self.client.replica.job(id))
    }

    async fn list(&self, filter: Filter) -> Result<Page, UnavailableError> {
        self.claims_recorded().await?;
        Ok(self.client.replica.lock().page(&filter))
    }

    async fn watch(&self, id: JobId) -> Result<Option<Watcher>, UnavailableError> {
        self.up_to_date(id).await?;
        Ok(self.client.replica.subscribe(id).map(Watcher::new))
    }

    async fn cancel(&self, id: JobId) -> Result<Option<Job>, UnavailableError> {
        self.claims_recorded().await?;
        self.client.cancel(id).await
    }

    async fn leave(&self, id: JobId, client: &str) -> Result<Option<Job>, UnavailableError> {
        self.claims_recorded().await?;
        self.client.leave(id, client).await
    }

    fn is_shared(&self) -> bool {
        true
    }

    async fn reachable(&self) -> Result<(), UnavailableError> {
        if self.client.nats.client.connection_state() != State::Connected {
            return Err(UnavailableError::new("the broker is not connected"));
        }
        match self.client.nats.denials.reported() {
            Some(denial) => {
                Err(UnavailableError(format!("the broker forbids an operation that jobs need: {denial}")))
            }
            None => Ok(()),
        }
    }

    fn counts(&self) -> Counts {
        self.client.replica.lock().counts
    }

    /// Detaches the jobs on which this process has claims: they continue, and a caller that submits them again joins
    /// them.
    /// [`Worker::drain`](super::Worker::drain) drains a worker, before.
    async fn drain(&self, limit: Duration) {
        self.client.draining.store(true, Ordering::Release);
        self.client.claims.detach_all();
        drop(timeout(limit.max(CLAIMS_TIMEOUT), self.client.claims.recorded()).await);
        self.client.closed.store(true, Ordering::Release);
        self.tasks.lock().abort_all();
        self.client.replica.lock().entries.clear();
        drop(timeout(CLAIMS_TIMEOUT, self.client.nats.client.flush()).await);
    }
}
