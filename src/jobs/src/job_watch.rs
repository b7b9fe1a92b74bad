//! Sends the changes of one job to its watchers.

use std::pin::Pin;
use std::task::{Context, Poll};
use std::time::Duration;

use futures_core::Stream;
use futures_util::{StreamExt, stream};
use tokio::sync::watch;
use tokio::time::{Instant, sleep_until};

use crate::clients::Clients;
use crate::job::{Job, State};

/// Least time between two changes of progress that one watcher receives.
const MIN_INTERVAL: Duration = Duration::from_millis(100);

/// Least change of progress.
const MIN_STEP: f64 = 1e-3;

/// The sending half.
///
/// Progress has a channel of its own: it changes a thousand times as often as the state, and must not wake up callers
/// that wait for the end.
#[derive(Clone)]
pub(crate) struct JobSender {
    job: watch::Sender<Job>,
    progress: watch::Sender<f64>,
}

impl JobSender {
    pub(crate) fn new(job: Job) -> Self {
        let progress = watch::Sender::new(job.progress);
        Self { job: watch::Sender::new(job), progress }
    }

    pub(crate) fn subscribe(&self) -> JobReceiver {
        JobReceiver { job: self.job.subscribe(), progress: self.progress.subscribe() }
    }

    pub(crate) fn job(&self) -> Job {
        with_progress(&self.job.borrow(), *self.progress.borrow())
    }

    pub(crate) fn state(&self) -> State {
        self.job.borrow().state
    }

    /// Changes the job and returns it.
    pub(crate) fn change(&self, change: impl FnOnce(&mut Job)) -> Job {
        self.job.send_modify(|job| {
            job.progress = job.progress.max(*self.progress.borrow());
            change(job);
        });
        self.job.borrow().clone()
    }

    /// Changes the job's clients. `change` returns whether it has changed them, and so does this.
    pub(crate) fn change_clients(&self, change: impl FnOnce(&mut Clients) -> bool) -> bool {
        self.job.send_if_modified(|job| change(&mut job.clients))
    }

    /// Sets the progress if it has grown by a step. Returns whether it has.
    pub(crate) fn set_progress(&self, fraction: f64) -> bool {
        self.progress.send_if_modified(|done| {
            let grows = fraction >= *done + MIN_STEP;
            if grows {
                *done = fraction.min(1.0);
            }
            grows
        })
    }
}

/// The receiving half.
#[derive(Clone)]
pub(crate) struct JobReceiver {
    job: watch::Receiver<Job>,
    progress: watch::Receiver<f64>,
}

impl JobReceiver {
    pub(crate) fn job(&self) -> Job {
        with_progress(&self.job.borrow(), *self.progress.borrow())
    }

    /// Waits for the job's end and returns the job; its last state if the back end closes before.
    pub(crate) async fn finished(&self) -> Job {
        let mut job = self.job.clone();
        // An error means that the sender is gone: the job does not change any more.
        drop(job.wait_for(|job| job.state.is_final()).await);
        self.job()
    }

    /// Waits for a change. Returns false if the back end has closed.
    async fn changed(&mut self) -> bool {
        tokio::select! {
            changed = self.job.changed() => changed.is_ok(),
            () = next_progress(&mut self.progress) => true,
        }
    }

    fn take(&mut self) -> Job {
        with_progress(&self.job.borrow_and_update(), *self.progress.borrow_and_update())
    }
}

fn with_progress(job: &Job, progress: f64) -> Job {
    let progress = if job.state == State::Running { job.progress.max(progress) } else { job.progress };
    Job { progress, ..job.clone() }
}

async fn next_progress(progress: &mut watch::Receiver<f64>) {
    let earliest = Instant::now() + MIN_INTERVAL;
    if progress.changed().await.is_err() {
        // The channel of the state ends as well, and delivers the last state.
        std::future::pending::<()>().await;
    }
    sleep_until(earliest).await;
}

/// Yields a job as it is, then after each change; progress at most some ten times a second. Ends after the final state,
/// or when the back end closes.
pub struct Watcher(Pin<Box<dyn Stream<Item = Job> + Send>>);

impl Watcher {
    pub(crate) fn new(mut receiver: JobReceiver) -> Self {
        let first = receiver.take();
        let rest = (!first.state.is_final()).then_some(receiver);
        let changes = stream::unfold(rest, |receiver| async {
            let mut receiver = receiver?;
            if !receiver.changed().await {
                return None;
            }
            let job = receiver.take();
            let rest = (!job.state.is_final()).then_some(receiver);
            Some((job, rest))
        });
        Self(Box::pin(stream::iter([first]).chain(changes)))
    }

    /// A watcher of a job that has ended.
    pub(crate) fn of_ended(job: Job) -> Self {
        Self(Box::pin(stream::iter([job])))
    }

    /// The next change; `None` after the last.
    pub async fn next(&mut self) -> Option<Job> {
        self.0.next().await
    }
}

impl Stream for Watcher {
    type Item = Job;

    fn poll_next(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Option<Job>> {
        self.0.as_mut().poll_next(context)
    }
}
