//! How one job's changes reach those who look at it.

use std::pin::Pin;
use std::task::{Context, Poll};
use std::time::Duration;

use futures_core::Stream;
use futures_util::{StreamExt, stream};
use tokio::sync::watch;
use tokio::time::{Instant, sleep_until};

use crate::{Clients, Job, State};

/// Least time between two changes of progress that one watcher sees.
const PACE: Duration = Duration::from_millis(100);

/// Progress is told apart in steps of this.
const STEP: f64 = 1e-3;

/// The writing end.
///
/// Progress goes by itself: it changes a thousand times as often as the state, and who waits for the end must not be
/// woken by it.
#[derive(Clone)]
pub(crate) struct Feeder {
    job: watch::Sender<Job>,
    progress: watch::Sender<f64>,
}

impl Feeder {
    pub(crate) fn new(job: Job) -> Self {
        let progress = watch::Sender::new(job.progress);
        Self { job: watch::Sender::new(job), progress }
    }

    pub(crate) fn subscribe(&self) -> Feed {
        Feed { job: self.job.subscribe(), progress: self.progress.subscribe() }
    }

    pub(crate) fn job(&self) -> Job {
        merged(&self.job.borrow(), *self.progress.borrow())
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

    /// Changes who its clients are; whether that changes anything.
    pub(crate) fn change_clients(&self, change: impl FnOnce(&mut Clients) -> bool) -> bool {
        self.job.send_if_modified(|job| change(&mut job.clients))
    }

    /// Whether it is further than before.
    pub(crate) fn progress(&self, part: f64) -> bool {
        self.progress.send_if_modified(|done| {
            let further = part >= *done + STEP;
            if further {
                *done = part.min(1.0);
            }
            further
        })
    }
}

/// The reading end.
#[derive(Clone)]
pub(crate) struct Feed {
    job: watch::Receiver<Job>,
    progress: watch::Receiver<f64>,
}

impl Feed {
    pub(crate) fn job(&self) -> Job {
        merged(&self.job.borrow(), *self.progress.borrow())
    }

    /// The job at its end, or as it stands when the back end closes before.
    pub(crate) async fn finished(&self) -> Job {
        let mut job = self.job.clone();
        // An error means that the writing end is gone: what is there is the last that will be.
        drop(job.wait_for(|job| job.state.is_final()).await);
        self.job()
    }

    /// Whether there is a change to look at; not when the back end has closed.
    async fn changed(&mut self) -> bool {
        tokio::select! {
            changed = self.job.changed() => changed.is_ok(),
            () = paced(&mut self.progress) => true,
        }
    }

    fn seen(&mut self) -> Job {
        merged(&self.job.borrow_and_update(), *self.progress.borrow_and_update())
    }
}

fn merged(job: &Job, progress: f64) -> Job {
    let progress = if job.state == State::Running { job.progress.max(progress) } else { job.progress };
    Job { progress, ..job.clone() }
}

async fn paced(progress: &mut watch::Receiver<f64>) {
    let earliest = Instant::now() + PACE;
    if progress.changed().await.is_err() {
        // The state's channel ends as well, and with the last state.
        std::future::pending::<()>().await;
    }
    sleep_until(earliest).await;
}

/// A job as it stands, then at each change; progress at most some ten times a second. Ends after the final
/// state, or when the back end closes.
pub struct Watcher(Pin<Box<dyn Stream<Item = Job> + Send>>);

impl Watcher {
    pub(crate) fn new(mut feed: Feed) -> Self {
        let first = feed.seen();
        let rest = (!first.state.is_final()).then_some(feed);
        let changes = stream::unfold(rest, |feed| async {
            let mut feed = feed?;
            if !feed.changed().await {
                return None;
            }
            let job = feed.seen();
            let rest = (!job.state.is_final()).then_some(feed);
            Some((job, rest))
        });
        Self(Box::pin(stream::iter([first]).chain(changes)))
    }

    /// Of a finished job.
    pub(crate) fn of(job: Job) -> Self {
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
