//! The back end inside the process: SQLite for what must last, memory for what moves.
//!
//! A process that dies leaves its queued and running jobs to the next one that opens the directory. Without a directory
//! all is as with one, in memory.

mod board;
mod config;
mod keeper;
mod parts;
mod queue;
mod recorder;
mod records;

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::thread;
use std::time::Duration;

use async_trait::async_trait;
use tokio::sync::Semaphore;
use tokio::time::timeout;

use crate::threads::pools;
use crate::threads::run::Told;
use crate::{
    Backend, Claim, Counts, Cursor, Filter, Job, JobId, Page, Submission, SubmitError, Unavailable, Watcher,
    Work,
};
use board::Board;
use keeper::Keeper;
use queue::Queue;
use recorder::Recorder;
use records::{Opened, Record, Records};

pub use config::{Config, OpenError};
pub use records::Retention;

/// How much nicer jobs are than who answers short questions in the same process: a tenth of its share of a full core.
const COURTESY: i32 = 10;

/// Callers that read the records at the same time; others wait.
const READERS: usize = 64;

/// How long the end of a drain may take to be recorded.
const CLOSING: Duration = Duration::from_secs(2);

/// Jobs kept in SQLite and run in this process. Dropped without a [drain](Backend::drain) it tells its runs to stop and
/// does not wait for them.
pub struct Embedded {
    keeper: Arc<Keeper>,
    readers: Semaphore,
    set_aside: Option<PathBuf>,
}

impl Embedded {
    /// Opens, or begins, the records, and sets to work on the jobs that are left in them. Reads the whole database: not for a
    /// thread of the runtime.
    pub fn open(config: Config, work: Arc<dyn Work>) -> Result<Self, OpenError> {
        let Opened { records, live, last_life, given_up, set_aside } =
            records::open(config.directory.as_deref(), config.retention, config.max_attempts)?;
        let seats = pools::seats(config.threads, config.slots, COURTESY)
            .map_err(|fault| OpenError::Threads(fault.to_string()))?;
        let threads = |fault: std::io::Error| OpenError::Threads(fault.to_string());
        let recorder = Recorder::start(records).map_err(threads)?;
        let board = Board::new(Queue::new(config.rule()), seats, last_life, given_up);
        let keeper = Arc::new(Keeper::new(board, recorder, config, work));
        let deadlines = Arc::clone(&keeper);
        thread::Builder::new()
            .name("jobs-deadlines".to_owned())
            .spawn(move || deadlines.watch_deadlines())
            .map_err(threads)?;
        keeper.resume(live);
        Ok(Self { keeper, readers: Semaphore::new(READERS), set_aside })
    }

    /// Where a damaged database was put when this one was begun in its place; its jobs are lost.
    pub fn set_aside(&self) -> Option<&Path> {
        self.set_aside.as_deref()
    }

    async fn read<T: Send + 'static>(
        &self,
        read: impl FnOnce(&Records) -> Result<T, Unavailable> + Send + 'static,
    ) -> Result<T, Unavailable> {
        let _permit = self.readers.acquire().await.map_err(|fault| Unavailable(fault.to_string()))?;
        self.keeper.recorder.read(read).await
    }

    fn live(&self, id: JobId) -> Option<Job> {
        self.keeper.board.lock().live.get(&id).map(|entry| entry.feeder.job())
    }

    /// The records' page, with what has happened since.
    fn refreshed(&self, records: Vec<Record>, filter: &Filter) -> Vec<Job> {
        let mut board = self.keeper.board.lock();
        let jobs = records.into_iter().map(|Record { life, job, .. }| match board.entry(job.id, life) {
            Some(entry) => entry.feeder.job(),
            None => job,
        });
        let client = filter.client.as_deref();
        jobs.filter(|job| filter.state.is_none_or(|state| state == job.state))
            .filter(|job| client.is_none_or(|client| job.clients.contains(client)))
            .collect()
    }
}

#[async_trait]
impl Backend for Embedded {
    async fn submit(&self, submission: Submission) -> Result<Claim, SubmitError> {
        let (claim, mut recorded) = self.keeper.submit(submission)?;
        let closed = || Unavailable("closed".to_owned());
        let result = recorded.wait_for(Option::is_some).await.map_err(|_| closed())?.clone();
        result.unwrap_or_else(|| Err(closed()))?;
        Ok(claim)
    }

    async fn get(&self, id: JobId) -> Result<Option<Job>, Unavailable> {
        match self.live(id) {
            Some(job) => Ok(Some(job)),
            None => self.read(move |records| records.get(id)).await,
        }
    }

    async fn list(&self, filter: Filter) -> Result<Page, Unavailable> {
        let limit = filter.limit.clamp(1, Filter::MAX_LIMIT);
        let wanted = filter.clone();
        let mut records = self.read(move |records| records.list(&wanted, limit + 1)).await?;
        let more = records.len() > limit;
        records.truncate(limit);
        let next = records.last().filter(|_| more).map(|record| Cursor(record.life));
        Ok(Page { jobs: self.refreshed(records, &filter), next })
    }

    async fn watch(&self, id: JobId) -> Result<Option<Watcher>, Unavailable> {
        let feed = self.keeper.board.lock().live.get(&id).map(|entry| entry.feeder.subscribe());
        match feed {
            Some(feed) => Ok(Some(Watcher::new(feed))),
            None => Ok(self.read(move |records| records.get(id)).await?.map(Watcher::of)),
        }
    }

    async fn cancel(&self, id: JobId) -> Result<Option<Job>, Unavailable> {
        match self.keeper.cancel(id) {
            Some(job) => {
                // Answered after the writes that were asked for before.
                self.read(|_| Ok(())).await?;
                Ok(Some(job))
            }
            None => self.read(move |records| records.get(id)).await,
        }
    }

    async fn leave(&self, id: JobId, client: &str) -> Result<Option<Job>, Unavailable> {
        match self.keeper.leave(id, client) {
            Some(job) => {
                // As with cancel.
                self.read(|_| Ok(())).await?;
                Ok(Some(job))
            }
            None => self.read(move |records| records.get(id)).await,
        }
    }

    /// It is in this process.
    fn reachable(&self) -> Result<(), Unavailable> {
        Ok(())
    }

    fn counts(&self) -> Counts {
        let board = self.keeper.board.lock();
        Counts {
            queued: board.queue.len(),
            running: board.running.len(),
            started: self.keeper.started.load(Ordering::Relaxed),
            succeeded: board.tally.succeeded,
            failed: board.tally.failed,
            cancelled: board.tally.cancelled,
        }
    }

    async fn drain(&self, limit: Duration) {
        self.stop();
        // The runs that do not stop in time go back to the queue all the same, though they are still under way.
        drop(timeout(limit, self.keeper.idle()).await);
        self.keeper.requeue_all();
        drop(timeout(CLOSING, self.keeper.recorder.close()).await);
        self.keeper.board.lock().live.clear();
    }
}

impl Embedded {
    fn stop(&self) {
        let mut board = self.keeper.board.lock();
        self.keeper.close(&mut board);
        board.running.values().for_each(|run| run.tell(Told::Drained));
    }
}

impl Drop for Embedded {
    fn drop(&mut self) {
        self.stop();
    }
}
