//! Fetches jobs of other clients for the guest slot while one client's jobs fill the main slots.

use std::sync::Arc;
use std::time::Duration;

use tokio::task::JoinSet;
use tokio::time::sleep;

use super::attempt::attempt;
use super::completion::hand_back;
use super::delivery;
use super::fetch::MAX_MOVED_BACK;
use super::shared::{ActiveJob, Shared, Stage};
use crate::jetstream::queue_class::QueueClass;

/// Time between two checks.
const INTERVAL: Duration = Duration::from_millis(100);

pub(super) async fn fetch_for_guests(shared: Arc<Shared>) {
    let mut jobs = JoinSet::new();
    while shared.is_open() {
        while jobs.try_join_next().is_some() {}
        if let Some(client) = only_client(&shared) {
            for class in QueueClass::ALL {
                fetch_other(&shared, &client, class, &mut jobs).await;
            }
        }
        tokio::select! {
            () = sleep(INTERVAL) => {}
            () = shared.reaches(Stage::Draining) => {}
        }
    }
    while jobs.join_next().await.is_some() {}
}

/// The client of all jobs in the main slots, if they are all busy and it is one.
fn only_client(shared: &Shared) -> Option<String> {
    let clients = shared.main_clients.lock();
    let client = clients.first().filter(|_| clients.len() == shared.main_slots)?;
    clients.iter().all(|other| other == client).then(|| client.clone())
}

/// Starts the first job of a queue that is not this client's. The client's own jobs before it move to the end of the
/// queue.
async fn fetch_other(shared: &Arc<Shared>, client: &str, class: QueueClass, jobs: &mut JoinSet<()>) {
    for _ in 0..MAX_MOVED_BACK {
        if !shared.client.replica.lock().has_other(client, class) {
            return;
        }
        let Some(slot) = shared.slots.take_guest() else {
            return;
        };
        let active = ActiveJob::new(shared);
        let Ok(Some(delivery)) = delivery::next(&shared.client, class, None).await else {
            return shared.slots.give_back(slot);
        };
        let is_own = shared.client.replica.job(delivery.id()).is_some_and(|job| job.client == client);
        if !is_own {
            drop(jobs.spawn(attempt(active, delivery, slot)));
            return;
        }
        shared.slots.give_back(slot);
        if !delivery.move_back(&shared.client).await {
            return hand_back(shared, delivery).await;
        }
    }
}
