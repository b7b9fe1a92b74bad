//! Jobs of others beside a main lane that one client has.

use std::sync::Arc;
use std::time::Duration;

use tokio::task::JoinSet;
use tokio::time::sleep;

use super::intake::MOST_PASSED;
use super::{Active, Desk, Stage, attempt, delivery};
use crate::jetstream::bus::Line;

/// How often a worker looks whether its main lane is one client's while others wait.
const LOOK: Duration = Duration::from_millis(100);

/// While all jobs on the main lane are of one client, takes those of others to the guest lane.
pub(super) async fn intake(desk: Arc<Desk>) {
    let mut jobs = JoinSet::new();
    while desk.is_open() {
        while jobs.try_join_next().is_some() {}
        if let Some(client) = desk.only_client() {
            for line in Line::ALL {
                guest(&desk, &client, line, &mut jobs).await;
            }
        }
        tokio::select! {
            () = sleep(LOOK) => {}
            () = desk.reaches(Stage::Draining) => {}
        }
    }
    while jobs.join_next().await.is_some() {}
}

/// Takes the first job of a line that is not this client's. The client's own jobs are put behind it.
async fn guest(desk: &Arc<Desk>, client: &str, line: Line, jobs: &mut JoinSet<()>) {
    for _ in 0..MOST_PASSED {
        if !desk.client.mirror.lock().has_other(client, line) {
            return;
        }
        let Some(seat) = desk.seats.take_guest() else {
            return;
        };
        let active = Active::new(desk);
        let Ok(Some(delivery)) = delivery::next(&desk.client, line, None).await else {
            return desk.seats.give(seat);
        };
        let own = desk.client.mirror.job(delivery.id).is_some_and(|job| job.client == client);
        if !own {
            drop(jobs.spawn(attempt::attempt(active, delivery, seat)));
            return;
        }
        desk.seats.give(seat);
        if !delivery.put_behind(&desk.client).await {
            return attempt::hand_back(desk, delivery).await;
        }
    }
}

impl Desk {
    /// The client of all jobs on the main lane, if the lane is full and it is one.
    fn only_client(&self) -> Option<String> {
        let held = self.held.lock();
        let client = held.first().filter(|_| held.len() == self.main)?;
        held.iter().all(|other| other == client).then(|| client.clone())
    }
}
