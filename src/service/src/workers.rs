//! Long computations run on rayon's threads; the runtime's threads only wait for them.

use std::panic::{AssertUnwindSafe, catch_unwind};

use tokio::sync::oneshot::{self, Sender};
use verne_solver::workspace::Observer;

use crate::error::Error;

/// Runs `work` on the worker threads. A panic in it is an internal error, not the end of the process.
pub(crate) async fn on_workers<T: Send + 'static>(
    work: impl FnOnce() -> Result<T, Error> + Send + 'static,
) -> Result<T, Error> {
    on_workers_while_waited_for(|_| work()).await
}

/// Runs `work` on the worker threads, and tells it by the observer to stop when the caller has gone.
pub(crate) async fn on_workers_while_waited_for<T: Send + 'static>(
    work: impl FnOnce(&dyn Observer) -> Result<T, Error> + Send + 'static,
) -> Result<T, Error> {
    let (sender, receiver) = oneshot::channel();
    rayon::spawn(move || {
        let waiting = Waiting(&sender);
        let outcome = catch_unwind(AssertUnwindSafe(|| work(&waiting))).unwrap_or(Err(Error::Internal));
        // Nobody waits any more when the caller has gone; then the answer is of no use.
        drop(sender.send(outcome));
    });
    receiver.await.unwrap_or(Err(Error::Internal))
}

/// Somebody waits for the answer, or nobody any more.
struct Waiting<'a, T>(&'a Sender<Result<T, Error>>);

impl<T: Send> Observer for Waiting<'_, T> {
    fn progress(&self, _part: f64) {}

    fn cancelled(&self) -> bool {
        self.0.is_closed()
    }
}
