//! The pool of compute threads (rayon's). Long computations run on it; the async runtime's threads only wait for them.

use std::num::NonZeroUsize;
use std::panic::{AssertUnwindSafe, catch_unwind};

use tokio::sync::oneshot;
use verne_solver::workspace::Observer;

use crate::operations::observers::ObserverFns;
use crate::wire::error::OperationError;

/// Gives the pool one thread less than there are cores. The runtime's threads answer single requests, and this leaves
/// them a core whatever batches run.
///
/// On two cores the pool has both: a batch at half the speed costs more than the single requests gain, because the
/// system's scheduler prefers threads that wake up. The setting is the process's and has no effect once a thread of the
/// pool runs.
pub(crate) fn leave_one_core_free() {
    let cores = std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
    let threads = rayon::ThreadPoolBuilder::new().num_threads(cores.saturating_sub(1).max(cores.min(2)));
    if let Err(error) = threads.build_global() {
        tracing::warn!(%error, "cannot limit the compute threads; there is one per core");
    }
}

/// Runs `work` on the pool and waits for it. The observer that `work` gets asks it to stop when the caller no longer
/// waits.
///
/// # Errors
///
/// Those of `work`; [`OperationError::Internal`] if `work` panics.
pub(crate) async fn run_on_pool<T: Send + 'static, E: From<OperationError> + Send + 'static>(
    work: impl FnOnce(&dyn Observer) -> Result<T, E> + Send + 'static,
) -> Result<T, E> {
    let (sender, receiver) = oneshot::channel();
    rayon::spawn(move || {
        // The caller may stop waiting before a thread is free.
        if sender.is_closed() {
            return;
        }
        let observer = ObserverFns { progress: |_| (), cancelled: || sender.is_closed() };
        let outcome = catch_unwind(AssertUnwindSafe(|| work(&observer)))
            .unwrap_or_else(|_| Err(OperationError::Internal.into()));
        // Sending fails if the caller no longer waits; nobody needs the answer then.
        drop(sender.send(outcome));
    });
    receiver.await.unwrap_or_else(|_| Err(OperationError::Internal.into()))
}
