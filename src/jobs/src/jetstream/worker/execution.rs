//! Runs a job on the threads of a slot.

use std::sync::Arc;

use tokio::sync::{oneshot, watch};

use super::shared::Shared;
use crate::execution::run::Run;
use crate::execution::slot::{Slot, SlotKind};
use crate::execution::stop::{RunEnd, StopSignal};
use crate::jetstream::record::Record;
use crate::job::{Failure, Outcome};
use crate::job_watch::JobSender;

/// The reason why a job needs a slot.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Phase {
    /// To ask for its subtasks, and to run if there are none.
    Start,
    /// To merge the results of its subtasks.
    Merge,
}

/// Runs a job in a slot, which it gives back.
pub(super) async fn execute(
    shared: &Arc<Shared>,
    record: &Record,
    slot: Slot,
    job: &JobSender,
    mut signal: watch::Receiver<Option<StopSignal>>,
    phase: Phase,
) -> RunEnd {
    let client = record.job.client.clone();
    let occupied = OccupiedSlot::new(shared, slot.clone(), client.clone());
    let preemption = Arc::clone(&shared.preemption);
    let run = Arc::new(Run::new(record.key(), phase == Phase::Merge, client, slot, job.clone(), preemption));
    let (sender, receiver) = oneshot::channel();
    let (work, payload) = (Arc::clone(&shared.work), record.job.payload.clone());
    let on_pool = Arc::clone(&run);
    run.slot.pool.spawn(move || {
        let end = on_pool.execute(work.as_ref(), &payload, || (), &|| ());
        drop(occupied);
        drop(sender.send(end));
    });
    let stopping = StopOnDrop(Arc::clone(&run));
    let forward = async {
        if let Ok(signal) = signal.wait_for(Option::is_some).await
            && let Some(signal) = *signal
        {
            run.stop(signal);
        }
        std::future::pending::<()>().await;
    };
    let lost = || RunEnd::Final(Outcome::Failed(Failure::Panicked("no message".to_owned())));
    let end = tokio::select! {
        end = receiver => end.unwrap_or_else(|_| lost()),
        () = forward => lost(),
    };
    drop(stopping);
    end
}

/// Stops a run whose task is dropped: nobody waits for its end.
struct StopOnDrop(Arc<Run>);

impl Drop for StopOnDrop {
    fn drop(&mut self) {
        self.0.stop(StopSignal::Drained);
    }
}

/// A slot in which a job of a client runs. Gives the slot back when its threads are free.
struct OccupiedSlot {
    shared: Arc<Shared>,
    slot: Slot,
    client: String,
}

impl OccupiedSlot {
    fn new(shared: &Arc<Shared>, slot: Slot, client: String) -> Self {
        if slot.kind == SlotKind::Main {
            shared.main_clients.lock().push(client.clone());
        }
        Self { shared: Arc::clone(shared), slot, client }
    }
}

impl Drop for OccupiedSlot {
    fn drop(&mut self) {
        if self.slot.kind == SlotKind::Main {
            let mut clients = self.shared.main_clients.lock();
            if let Some(position) = clients.iter().position(|client| *client == self.client) {
                clients.swap_remove(position);
            }
        }
        self.shared.slots.give_back(self.slot.clone());
    }
}
