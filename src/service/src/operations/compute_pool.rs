//! Long computations run on rayon's threads; the runtime's threads only wait for them.

use std::num::NonZeroUsize;
use std::panic::{AssertUnwindSafe, catch_unwind};

use tokio::sync::oneshot::{self, Sender};
use verne_solver::workspace::Observer;

use crate::wire::error::OperationError;

/// Has one worker thread less than cores: single questions, which the runtime's threads answer, keep one whatever batches
/// there are. Of two cores batches have both: half as fast is too dear for what the system's scheduler gives to who wakes
/// up anyway. For the process; without effect once a worker thread runs.
pub(crate) fn spare_a_core() {
    let cores = std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
    let threads = rayon::ThreadPoolBuilder::new().num_threads(cores.saturating_sub(1).max(cores.min(2)));
    if let Err(error) = threads.build_global() {
        tracing::warn!(%error, "cannot limit the worker threads; there is one per core");
    }
}

/// Runs `work` on the worker threads. A panic in it is an internal error, not the end of the process.
pub(crate) async fn on_workers<T: Send + 'static, E: From<OperationError> + Send + 'static>(
    work: impl FnOnce() -> Result<T, E> + Send + 'static,
) -> Result<T, E> {
    on_workers_while_waited_for(|_| work()).await
}

/// Runs `work` on the worker threads, and tells it by the observer to stop when the caller has gone.
pub(crate) async fn on_workers_while_waited_for<
    T: Send + 'static,
    E: From<OperationError> + Send + 'static,
>(
    work: impl FnOnce(&dyn Observer) -> Result<T, E> + Send + 'static,
) -> Result<T, E> {
    let (sender, receiver) = oneshot::channel();
    rayon::spawn(move || {
        let waiting = Waiting(&sender);
        // Its turn may come after the caller has gone.
        if waiting.cancelled() {
            return;
        }
        let outcome = catch_unwind(AssertUnwindSafe(|| work(&waiting)))
            .unwrap_or_else(|_| Err(OperationError::Internal.into()));
        // Nobody waits any more when the caller has gone; then the answer is of no use.
        drop(sender.send(outcome));
    });
    receiver.await.unwrap_or_else(|_| Err(OperationError::Internal.into()))
}

/// Somebody waits for the answer, or nobody any more.
struct Waiting<'a, T>(&'a Sender<T>);

impl<T: Send> Observer for Waiting<'_, T> {
    fn progress(&self, _part: f64) {}

    fn cancelled(&self) -> bool {
        self.0.is_closed()
    }
}
