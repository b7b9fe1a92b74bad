//! Who waits in this process, and how the records are told.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, Weak};
use std::time::Duration;

use futures_util::{StreamExt, stream};
use parking_lot::Mutex;
use tokio::sync::{mpsc, oneshot};

use super::client::Client;
use super::record::Claimant;
use crate::claim::Interest;
use crate::threads::run::Told;
use crate::{JobId, Unavailable};

/// A life of a job.
type Life = (JobId, u64);

/// What is to be done about claims.
pub(super) enum Settle {
    /// They have changed.
    Changed(Life),
    /// Dropped when all that came before is done.
    Told(oneshot::Sender<()>),
}

/// Records that are brought up to date at the same time.
const AT_ONCE: usize = 64;

/// Most changes that are taken together.
const BATCH: usize = 4096;

/// How soon what could not be written is tried again.
const RETRY: Duration = Duration::from_secs(1);

pub(super) struct Claims {
    held: Mutex<BTreeMap<Life, Held>>,
    settle: mpsc::UnboundedSender<Settle>,
}

#[derive(Clone, Copy, Default)]
struct Held {
    claims: usize,
    kept: bool,
}

impl Claims {
    pub(super) fn new(settle: mpsc::UnboundedSender<Settle>) -> Self {
        Self { held: Mutex::default(), settle }
    }

    pub(super) fn add(&self, life: Life) {
        self.held.lock().entry(life).or_default().claims += 1;
    }

    /// Returns when all changes that came before are in the records, or have been tried.
    pub(super) async fn settled(&self) {
        let (sender, receiver) = oneshot::channel();
        if self.settle.send(Settle::Told(sender)).is_ok() {
            drop(receiver.await);
        }
    }

    /// Has every job that somebody here waits for kept.
    pub(super) fn keep_all(&self) {
        let mut held = self.held.lock();
        for (life, held) in held.iter_mut() {
            held.kept = true;
            drop(self.settle.send(Settle::Changed(*life)));
        }
    }

    /// Has the record brought up to date.
    pub(super) fn look_at(&self, life: Life) {
        self.change(life, |_| ());
    }

    fn change(&self, life: Life, change: impl FnOnce(&mut Held)) {
        change(self.held.lock().entry(life).or_default());
        drop(self.settle.send(Settle::Changed(life)));
    }
}

/// One claim on one life of a job.
pub(super) struct Stake {
    client: Weak<Client>,
    life: Life,
}

impl Stake {
    pub(super) fn new(client: &Arc<Client>, life: Life) -> Self {
        client.claims.add(life);
        Self { client: Arc::downgrade(client), life }
    }
}

impl Interest for Stake {
    fn keep(&self) {
        if let Some(client) = self.client.upgrade() {
            client.claims.change(self.life, |held| held.kept = true);
        }
    }
}

impl Drop for Stake {
    fn drop(&mut self) {
        if let Some(client) = self.client.upgrade() {
            client.claims.change(self.life, |held| held.claims = held.claims.saturating_sub(1));
        }
    }
}

/// Brings the records up to date with the claims, until nobody can claim any more.
pub(super) async fn settle(client: Arc<Client>, mut changes: mpsc::UnboundedReceiver<Settle>) {
    let mut again = BTreeSet::new();
    loop {
        let mut batch = Vec::new();
        if again.is_empty() {
            changes.recv_many(&mut batch, BATCH).await;
            if batch.is_empty() {
                return;
            }
        } else {
            let more = tokio::time::timeout(RETRY, changes.recv_many(&mut batch, BATCH));
            drop(more.await);
        }
        let mut lives = std::mem::take(&mut again);
        let mut told = Vec::new();
        for change in batch {
            match change {
                Settle::Changed(life) => drop(lives.insert(life)),
                Settle::Told(sender) => told.push(sender),
            }
        }
        let settled = stream::iter(lives).map(|life| {
            let client = &client;
            async move { (life, client.settle(life).await) }
        });
        let settled: Vec<_> = settled.buffer_unordered(AT_ONCE).collect().await;
        for (life, outcome) in settled {
            if let Err(fault) = outcome {
                tracing::warn!(%fault, "a claim on a job is not recorded yet");
                again.insert(life);
            }
        }
    }
}

impl Client {
    async fn settle(&self, life: Life) -> Result<(), Unavailable> {
        let _shard = self.shard(life.0).await;
        let Some(held) = self.claims.held.lock().get(&life).copied() else {
            return Ok(());
        };
        let process = Claimant::Process(self.process);
        let settled = self.change(life.0, |record| {
            if record.life != life.1 || !record.goes_on() {
                return false;
            }
            let mut changes = held.kept && !record.kept;
            record.kept |= held.kept;
            if held.claims == 0 && record.claimants.remove(&process) {
                changes = true;
                if !record.is_wanted() {
                    record.stop(Told::Cancelled);
                }
            }
            changes
        });
        settled.await?;
        let mut all = self.claims.held.lock();
        if all.get(&life).is_some_and(|held| held.claims == 0) {
            all.remove(&life);
        }
        Ok(())
    }
}
