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
    Backend, Claim, Counts, Cursor, Filter, Job, JobId, Page, Seats, Submission, SubmitError, Unavailable,
    Watcher, Work,
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
    seats: usize,
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
        let places = seats.len();
        let board = Board::new(Queue::new(config.overdue), seats, last_life, given_up);
        let keeper = Arc::new(Keeper::new(board, recorder, config, work));
        let deadlines = Arc::clone(&keeper);
        thread::Builder::new()
            .name("jobs-deadlines".to_owned())
            .spawn(move || deadlines.watch_deadlines())
            .map_err(threads)?;
        keeper.resume(live);
        Ok(Self { keeper, readers: Semaphore::new(READERS), set_aside, seats: places })
    }

    /// Where a damaged database was put when this one was begun in its place; its jobs are lost.
    pub fn set_aside(&self) -> Option<&Path> {
        self.set_aside.as_deref()
    }

    /// How busy it is.
    pub fn seats(&self) -> Seats {
        let free = self.keeper.board.lock().free.len();
        Seats { all: self.seats, busy: self.seats.saturating_sub(free) }
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

    /// As the last changes went, while the database's files are in their places. After a change that was refused as much is
    /// written anew, so that it is known when there is room again though nobody submits anything.
    async fn reachable(&self) -> Result<(), Unavailable> {
        if !self.keeper.recorder.is_failing() {
            return self.read(Records::check_files).await;
        }
        self.read(self.keeper.recorder.probe()).await
    }

    fn is_shared(&self) -> bool {
        false
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

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use std::sync::Arc;

    use bytes::Bytes;
    use tempfile::TempDir;

    use super::{Config, Embedded};
    use crate::{Backend, JobId, Stop, Submission, SubmitError, Watch, Work};

    struct Nothing;

    impl Work for Nothing {
        fn run(&self, _: &JobId, _: &[u8], _: &dyn Watch) -> Result<(), Stop> {
            Ok(())
        }
    }

    fn submission(number: u8) -> Submission {
        let (id, payload) = (JobId::from_bytes([number; 32]), Bytes::from_static(b"{}"));
        Submission { id, client: String::new(), cost: 1.0, payload, deadline: None }
    }

    async fn refuse_writes(jobs: &Embedded, refuse: bool) {
        jobs.read(move |records| records.refuse_writes(refuse)).await.unwrap();
    }

    #[tokio::test]
    async fn a_disk_that_takes_nothing_is_told_until_it_does_again() {
        let directory = TempDir::new().unwrap();
        let jobs = Embedded::open(Config::in_directory(directory.path()), Arc::new(Nothing)).unwrap();
        assert_eq!(jobs.reachable().await, Ok(()));
        refuse_writes(&jobs, true).await;
        let refused = jobs.submit(submission(1)).await.map(drop).unwrap_err();
        assert!(matches!(refused, SubmitError::Unavailable(_)), "{refused}");
        for _ in 0..2 {
            assert!(jobs.reachable().await.is_err());
        }
        // Nobody submits anything.
        refuse_writes(&jobs, false).await;
        assert_eq!(jobs.reachable().await, Ok(()));
    }

    #[tokio::test]
    async fn what_is_recorded_ends_the_failure() {
        let jobs = Embedded::open(Config::default(), Arc::new(Nothing)).unwrap();
        refuse_writes(&jobs, true).await;
        jobs.submit(submission(1)).await.map(drop).unwrap_err();
        refuse_writes(&jobs, false).await;
        assert!(jobs.keeper.recorder.is_failing());
        jobs.submit(submission(2)).await.unwrap();
        assert!(!jobs.keeper.recorder.is_failing());
    }
}
