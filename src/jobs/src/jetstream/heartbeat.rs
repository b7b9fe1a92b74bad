//! Heartbeats of processes. A process without heartbeats has no claims any more.

use std::collections::HashMap;
use std::sync::Arc;
use std::time::{Duration, Instant};

use tokio::time::MissedTickBehavior;

use super::client::Client;
use super::record::Claimant;

/// Sends heartbeats, in a task of its own: other work must not delay them.
pub(super) async fn send_heartbeats(client: Arc<Client>) {
    let mut tick = tokio::time::interval(client.nats.config.lease / 4);
    tick.set_missed_tick_behavior(MissedTickBehavior::Delay);
    loop {
        tick.tick().await;
        client.nats.broadcast("alive", client.process.to_be_bytes().to_vec()).await;
    }
}

/// When each process sent its last heartbeat.
pub(super) struct Heartbeats {
    own: u64,
    lease: Duration,
    last: HashMap<u64, Instant>,
    /// Since then the broker delivers this process's own heartbeats.
    connected: Instant,
}

impl Heartbeats {
    pub(super) fn new(own: u64, lease: Duration) -> Self {
        Self { own, lease, last: HashMap::new(), connected: Instant::now() }
    }

    pub(super) fn receive(&mut self, process: u64) {
        let last = self.last.insert(process, Instant::now());
        if process == self.own && last.is_none_or(|last| last.elapsed() > self.lease / 2) {
            self.connected = Instant::now();
        }
    }

    /// Starts the lease of processes whose claims appear for the first time, and forgets processes that are gone.
    pub(super) fn update<'a>(&mut self, claimants: impl Iterator<Item = &'a Claimant>) {
        for claimant in claimants {
            if let Claimant::Process(process) = claimant {
                self.last.entry(*process).or_insert_with(Instant::now);
            }
        }
        self.last.retain(|_, last| last.elapsed() < 2 * self.lease);
    }

    /// Whether the lease of a process has ended. Never true if this process could not have received its heartbeats.
    pub(super) fn is_gone(&self, process: u64) -> bool {
        let is_silent =
            |process: u64, limit: Duration| self.last.get(&process).is_none_or(|last| last.elapsed() > limit);
        process != self.own
            && self.connected.elapsed() > self.lease
            && !is_silent(self.own, self.lease / 2)
            && is_silent(process, self.lease)
    }
}
