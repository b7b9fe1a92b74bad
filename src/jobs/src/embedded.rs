//! The back end in one process: SQLite records jobs durably, and memory holds their progress.
//!
//! If the process dies, the next one that opens the directory runs its queued and running jobs. Without a directory the
//! database is in memory and everything else is the same.

mod config;
mod job_table;
mod queue;
mod records;
mod scheduler;
mod waiting_parent;
mod writer;

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread;
use std::time::Duration;

use async_trait::async_trait;
use tokio::sync::Semaphore;
use tokio::time::timeout;

use crate::backend::Backend;
use crate::claim::Claim;
use crate::counts::{Counts, Slots};
use crate::error::{SubmitError, UnavailableError};
use crate::execution::slot::slots;
use crate::job::{Job, Submission};
use crate::job_id::{JobId, JobKey};
use crate::job_watch::Watcher;
use crate::page::{Cursor, Filter, Page};
use crate::work::Work;
use job_table::JobTable;
use queue::Queue;
use records::Records;
use records::open::Opened;
use scheduler::Scheduler;
use writer::Writer;

pub use config::{Config, OpenError};

/// Added to the niceness of job threads: on a busy core they get about a tenth of the time of the threads that answer
/// short requests.
const NICENESS: i32 = 10;

/// Most callers that read the records at the same time; others wait.
const READERS: usize = 64;

/// Longest time to record the end of a drain.
const CLOSE_TIMEOUT: Duration = Duration::from_secs(2);

/// Records jobs in SQLite and runs them in this process. If it is dropped without a [drain](Backend::drain), it tells
/// its runs to stop and does not wait for them.
pub struct Embedded {
    scheduler: Arc<Scheduler>,
    readers: Semaphore,
    damaged_database: Option<PathBuf>,
    slots: usize,
}

impl Embedded {
    /// Opens or creates the database and starts the jobs in it. Reads the whole database: do not call it on a thread of
    /// the runtime.
    ///
    /// # Errors
    ///
    /// Another process uses the directory; the database is a later version's; a file cannot be used; or threads cannot
    /// be started.
    pub fn open(config: Config, work: Arc<dyn Work>) -> Result<Self, OpenError> {
        let Opened { records, unfinished, last_generation, given_up, damaged_database } =
            records::open::open(config.directory.as_deref(), config.retention, config.max_attempts)?;
        let free_slots = slots(config.threads, config.slots, NICENESS)
            .map_err(|error| OpenError::Threads(error.to_string()))?;
        let no_thread = |error: std::io::Error| OpenError::Threads(error.to_string());
        let writer = Writer::start(records).map_err(no_thread)?;
        let slots = free_slots.len();
        let table = JobTable::new(Queue::new(config.overdue_after), free_slots, last_generation, given_up);
        let scheduler = Arc::new(Scheduler::new(table, writer, config, work));
        let deadlines = Arc::clone(&scheduler);
        thread::Builder::new()
            .name("jobs-deadlines".to_owned())
            .spawn(move || deadlines.watch_deadlines())
            .map_err(no_thread)?;
        scheduler.resume(unfinished);
        Ok(Self { scheduler, readers: Semaphore::new(READERS), damaged_database, slots })
    }

    /// New path of a damaged database, if this call of [`Embedded::open`] has replaced one. Its jobs are lost.
    pub fn damaged_database(&self) -> Option<&Path> {
        self.damaged_database.as_deref()
    }

    /// Slots of this process.
    pub fn slots(&self) -> Slots {
        let free = self.scheduler.table.lock().free_slots.len();
        Slots { total: self.slots, busy: self.slots.saturating_sub(free) }
    }

    async fn read<T: Send + 'static>(
        &self,
        read: impl FnOnce(&Records) -> Result<T, UnavailableError> + Send + 'static,
    ) -> Result<T, UnavailableError> {
        let _permit = self.readers.acquire().await.map_err(UnavailableError::new)?;
        self.scheduler.writer.read(read).await
    }

    /// A changed job, when the changes before are recorded; without one, the job's record.
    async fn recorded(&self, id: JobId, changed: Option<Job>) -> Result<Option<Job>, UnavailableError> {
        match changed {
            Some(job) => self.read(|_| Ok(Some(job))).await,
            None => self.read(move |records| records.get(id)).await,
        }
    }
}

#[async_trait]
impl Backend for Embedded {
    async fn submit(&self, submission: Submission) -> Result<Claim, SubmitError> {
        let (claim, mut recorded) = self.scheduler.submit(submission)?;
        let result =
            recorded.wait_for(Option::is_some).await.map_err(|_| UnavailableError::closed())?.clone();
        result.unwrap_or_else(|| Err(UnavailableError::closed()))?;
        Ok(claim)
    }

    async fn get(&self, id: JobId) -> Result<Option<Job>, UnavailableError> {
        let live = self.scheduler.table.lock().jobs.get(&id).map(|entry| entry.job.job());
        match live {
            Some(job) => Ok(Some(job)),
            None => self.recorded(id, None).await,
        }
    }

    async fn list(&self, filter: Filter) -> Result<Page, UnavailableError> {
        let (size, wanted) = (filter.page_size(), filter.clone());
        // One record more shows whether there is a next page.
        let mut records = self.read(move |records| records.list(&wanted, size + 1)).await?;
        let has_more = records.len() > size;
        records.truncate(size);
        let next = records.last().filter(|_| has_more).map(|record| Cursor(record.generation));
        let mut table = self.scheduler.table.lock();
        let present = records.into_iter().map(|record| {
            let live = table.entry(JobKey { id: record.job.id, generation: record.generation });
            live.map_or(record.job, |entry| entry.job.job())
        });
        Ok(Page { jobs: present.filter(|job| filter.matches(job)).collect(), next })
    }

    async fn watch(&self, id: JobId) -> Result<Option<Watcher>, UnavailableError> {
        let live = self.scheduler.table.lock().jobs.get(&id).map(|entry| entry.job.subscribe());
        match live {
            Some(job) => Ok(Some(Watcher::new(job))),
            None => Ok(self.recorded(id, None).await?.map(Watcher::of_ended)),
        }
    }

    async fn cancel(&self, id: JobId) -> Result<Option<Job>, UnavailableError> {
        let changed = self.scheduler.cancel(id);
        self.recorded(id, changed).await
    }

    async fn leave(&self, id: JobId, client: &str) -> Result<Option<Job>, UnavailableError> {
        let changed = self.scheduler.leave(id, client);
        self.recorded(id, changed).await
    }

    /// Checks that the database's files are in place. After a change has failed, writes as many bytes again; so the end
    /// of the failure is found though nobody submits a job.
    async fn reachable(&self) -> Result<(), UnavailableError> {
        if self.scheduler.writer.is_failing() {
            let _permit = self.readers.acquire().await.map_err(UnavailableError::new)?;
            return self.scheduler.writer.probe().await;
        }
        self.read(Records::check_files).await
    }

    fn is_shared(&self) -> bool {
        false
    }

    fn counts(&self) -> Counts {
        let table = self.scheduler.table.lock();
        Counts { queued: table.queue.len(), running: table.running.len(), ..table.counts }
    }

    async fn drain(&self, limit: Duration) {
        self.scheduler.close();
        // Jobs whose runs do not stop in time return to the queue too.
        drop(timeout(limit, self.scheduler.wait_until_idle()).await);
        self.scheduler.requeue_running();
        drop(timeout(CLOSE_TIMEOUT, self.scheduler.writer.close()).await);
        self.scheduler.table.lock().jobs.clear();
    }
}

impl Drop for Embedded {
    fn drop(&mut self) {
        self.scheduler.close();
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use std::sync::Arc;

    use bytes::Bytes;
    use tempfile::TempDir;

    use super::{Config, Embedded};
    use crate::{Backend, JobId, RunControl, Submission, SubmitError, Work, WorkError};

    struct NoWork;

    impl Work for NoWork {
        fn run(&self, _: &JobId, _: &[u8], _: &dyn RunControl) -> Result<(), WorkError> {
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
    async fn a_disk_that_refuses_writes_is_reported_until_it_accepts_them() {
        let directory = TempDir::new().unwrap();
        let jobs = Embedded::open(Config::in_directory(directory.path()), Arc::new(NoWork)).unwrap();
        assert_eq!(jobs.reachable().await, Ok(()));
        refuse_writes(&jobs, true).await;
        let refused = jobs.submit(submission(1)).await.map(drop).unwrap_err();
        assert!(matches!(refused, SubmitError::Unavailable(_)), "{refused}");
        for _ in 0..2 {
            assert!(jobs.reachable().await.is_err());
        }
        // Nobody submits a job.
        refuse_writes(&jobs, false).await;
        assert_eq!(jobs.reachable().await, Ok(()));
    }

    #[tokio::test]
    async fn a_recorded_job_ends_the_failure() {
        let jobs = Embedded::open(Config::default(), Arc::new(NoWork)).unwrap();
        refuse_writes(&jobs, true).await;
        jobs.submit(submission(1)).await.map(drop).unwrap_err();
        refuse_writes(&jobs, false).await;
        assert!(jobs.scheduler.writer.is_failing());
        jobs.submit(submission(2)).await.unwrap();
        assert!(!jobs.scheduler.writer.is_failing());
    }
}
