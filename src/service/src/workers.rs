//! Long computations run on rayon's threads; the runtime's threads only wait for them.

use std::panic::{AssertUnwindSafe, catch_unwind};

use tokio::sync::oneshot;

use crate::error::Error;

/// Runs `work` on the worker threads. A panic in it is an internal error, not the end of the process.
pub(crate) async fn on_workers<T: Send + 'static>(
    work: impl FnOnce() -> Result<T, Error> + Send + 'static,
) -> Result<T, Error> {
    let (sender, receiver) = oneshot::channel();
    rayon::spawn(move || {
        let outcome = catch_unwind(AssertUnwindSafe(work)).unwrap_or(Err(Error::Internal));
        // Nobody waits any more when the caller has gone; then the answer is of no use.
        drop(sender.send(outcome));
    });
    receiver.await.unwrap_or(Err(Error::Internal))
}
