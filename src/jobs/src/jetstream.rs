//! The back end of many processes: a broker, NATS JetStream 2.10 or later, keeps the records and the queue.
//!
//! A process that [connects](JetStream::connect) submits, watches and cancels; one that also has a [`Worker`] runs jobs. All are
//! equal otherwise; none keeps anything that must last.
//!
//! # What is kept where
//!
//! A bucket (`NAME-jobs`) has each job's record by its id, written by compare-and-set: of equal submissions in any
//! processes one begins the job and the others join it. A stream (`NAME-queue`) has a message for each job that is queued or
//! runs, in a line for small jobs, one for parts and one for large jobs. The record is first: a message may come late or
//! twice, and then says nothing new. How far a job is, and which processes there are, is told and not kept.
//!
//! Every name has the layout of what is kept under it. Processes of another layout are at the same broker as if at another:
//! so programs are replaced one after the other, and each job is run by those that read it.
//!
//! # What holds
//!
//! - A job that was taken is not lost while the broker keeps what it acknowledged (`sync_interval: always` if that is one
//!   machine): neither by the loss of its worker, whose message comes back after [`ack_wait`](Config::ack_wait), nor of the process
//!   that submitted it, whether before or after it queued it: [any process](Config::mend_after) queues what is recorded.
//! - It is run by one worker at a time, as long as that is heard of; a worker that was given up and comes back finds its
//!   attempt replaced and stops. Its result is acknowledged after it is stored and recorded.
//! - A job whose workers were lost [so many times](Config::max_attempts) fails, which the broker tells.
//! - Who claims a job is in its record, by process. A process that is [not heard of](Config::lease) claims nothing any more, so
//!   its jobs are cancelled as if it had dropped them, unless they were kept.
//! - The claims on parts are their whole's, whoever runs it; they end with it.
//!
//! # What does not hold, other than [`Embedded`](crate::Embedded)
//!
//! - Order: within a line first come, first served, but that a job is put at the end of its line when in that line a job
//!   waits of a client that has fewer jobs running. A worker puts up to 64 jobs behind others before it begins one. Costs do
//!   not count. A worker's main lane takes from all lines as they have work; its express lane takes small jobs, so these
//!   overtake. A worker whose main lane has jobs of one client alone looks ten times a second for a job of another client, and
//!   runs it on its guest lane. Parts do not wait behind the large jobs that came before their whole had begun. A whole's
//!   merge is the next in its worker.
//! - What others do is known a moment later, some milliseconds, so bounds may be passed by as many as are submitted at
//!   once, and a part may still begin when its whole has just failed.
//! - A whole that waits while its worker is lost counts an attempt.
//! - The clocks of the machines must agree as well as deadlines and the order of lists are to.

mod access;
mod bus;
mod claims;
mod client;
mod config;
mod denials;
mod listen;
mod mirror;
mod poison;
mod record;
mod steward;
mod worker;

use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

use async_nats::connection::State;
use async_trait::async_trait;
use tokio::sync::{mpsc, watch};
use tokio::task::JoinSet;
use tokio::time::timeout;

use crate::{
    Backend, Claim, Counts, Cursor, Filter, Job, JobId, Page, Submission, SubmitError, Unavailable, Watcher,
};
use bus::Bus;
use claims::Stake;
use client::Client;
use record::Claimant;

pub use config::{Config, ConnectError, Setting, WorkerConfig};
pub use worker::{Occupancy, Worker};

/// How long the first reading of the records may take.
const CATCHING_UP: Duration = Duration::from_secs(30);

/// How long claims are waited for to be recorded.
const SETTLING: Duration = Duration::from_secs(5);

/// A process's connection to the jobs of all.
pub struct JetStream {
    client: Arc<Client>,
    /// Aborted with this.
    tasks: parking_lot::Mutex<JoinSet<()>>,
}

impl JetStream {
    /// Connects, makes what is missing at the broker, and reads the records.
    pub async fn connect(config: Config) -> Result<Self, ConnectError> {
        let bus = Box::pin(Bus::connect(config)).await?;
        let (settle, changes) = mpsc::unbounded_channel();
        let client = Arc::new(Client::new(bus, settle));
        let (sender, mut caught_up) = watch::channel(false);
        let mut tasks = JoinSet::new();
        tasks.spawn(listen::records(Arc::clone(&client), sender));
        tasks.spawn(listen::progress(Arc::clone(&client)));
        tasks.spawn(claims::settle(Arc::clone(&client), changes));
        let late = || ConnectError::Broker("the records of jobs cannot be read".to_owned());
        let read = timeout(CATCHING_UP, caught_up.wait_for(|done| *done)).await.map_err(|_| late())?;
        drop(read.map_err(|_| late())?);
        tasks.spawn(steward::keep_house(Arc::clone(&client)));
        tasks.spawn(steward::show_life(Arc::clone(&client)));
        tasks.spawn(poison::give_up(Arc::clone(&client)));
        tasks.spawn(denials::watch(Arc::clone(&client)));
        Ok(Self { client, tasks: parking_lot::Mutex::new(tasks) })
    }

    /// Returns when the claims that were dropped before are in the records.
    async fn settled(&self) -> Result<(), Unavailable> {
        if self.client.closed.load(Ordering::Acquire) {
            return Err(Unavailable("closed".to_owned()));
        }
        let late = |_| Unavailable("the broker does not answer".to_owned());
        timeout(SETTLING, self.client.claims.settled()).await.map_err(late)
    }

    /// Returns when the job is in the mirror, or the broker does not have it: another process may have just begun it.
    async fn heard_of(&self, id: JobId) -> Result<(), Unavailable> {
        self.settled().await?;
        if self.client.mirror.revision(id).is_none() {
            self.client.refresh(id).await?;
        }
        Ok(())
    }
}

async fn claim(client: Arc<Client>, submission: Submission) -> Result<Claim, SubmitError> {
    let id = submission.id;
    let _shard = client.shard(id).await;
    let line = client.bus.config.line(submission.cost);
    let record = client.submit(&submission, Claimant::Process(client.process), line).await?;
    let stake = Stake::new(&client, (id, record.life));
    let feed = client.mirror.feed(id, record.life);
    let feed = feed.ok_or_else(|| Unavailable("another has begun the job anew".to_owned()))?;
    Ok(Claim::new(feed, Box::new(stake)))
}

#[async_trait]
impl Backend for JetStream {
    async fn submit(&self, submission: Submission) -> Result<Claim, SubmitError> {
        // In a task of its own: who goes away meanwhile leaves no claim behind that nobody has.
        let submitted = tokio::spawn(claim(Arc::clone(&self.client), submission));
        submitted.await.unwrap_or_else(|fault| Err(Unavailable(fault.to_string()).into()))
    }

    async fn get(&self, id: JobId) -> Result<Option<Job>, Unavailable> {
        self.heard_of(id).await?;
        Ok(self.client.mirror.job(id))
    }

    async fn list(&self, filter: Filter) -> Result<Page, Unavailable> {
        self.settled().await?;
        let (jobs, next) = self.client.mirror.lock().page(&filter);
        Ok(Page { jobs, next: next.map(Cursor) })
    }

    async fn watch(&self, id: JobId) -> Result<Option<Watcher>, Unavailable> {
        self.heard_of(id).await?;
        let board = self.client.mirror.lock();
        Ok(board.entries.get(&id).map(|entry| Watcher::new(entry.feeder.subscribe())))
    }

    async fn cancel(&self, id: JobId) -> Result<Option<Job>, Unavailable> {
        self.settled().await?;
        self.client.cancel(id).await
    }

    async fn leave(&self, id: JobId, client: &str) -> Result<Option<Job>, Unavailable> {
        self.settled().await?;
        self.client.leave(id, client).await
    }

    fn is_shared(&self) -> bool {
        true
    }

    async fn reachable(&self) -> Result<(), Unavailable> {
        if self.client.bus.client.connection_state() != State::Connected {
            return Err(Unavailable("the broker is not connected".to_owned()));
        }
        match self.client.bus.denials.reported() {
            Some(denial) => Err(Unavailable(format!("the broker forbids what jobs need: {denial}"))),
            None => Ok(()),
        }
    }

    fn counts(&self) -> Counts {
        self.client.mirror.lock().counts
    }

    /// Jobs that somebody waits for here are kept: they go on, and who asks again finds them. Workers are drained by
    /// themselves, before.
    async fn drain(&self, limit: Duration) {
        self.client.draining.store(true, Ordering::Release);
        self.client.claims.keep_all();
        drop(timeout(limit.max(SETTLING), self.client.claims.settled()).await);
        self.client.closed.store(true, Ordering::Release);
        self.tasks.lock().abort_all();
        self.client.mirror.lock().entries.clear();
        drop(timeout(SETTLING, self.client.bus.client.flush()).await);
    }
}
