//! Writes the claims of this process into the records of jobs.

use std::collections::BTreeSet;
use std::sync::{Arc, Weak};
use std::time::Duration;

use futures_util::{StreamExt, stream};
use tokio::sync::mpsc;

use super::claims::ClaimChange;
use super::client::Client;
use super::record::Claimant;
use crate::claim::ClaimGuard;
use crate::error::UnavailableError;
use crate::execution::stop::StopSignal;
use crate::job_id::JobKey;

/// Most records that are written at the same time.
const CONCURRENT: usize = 64;

/// Most changes that are processed together.
const BATCH: usize = 4096;

/// Time after which a failed write is tried again.
const RETRY: Duration = Duration::from_secs(1);

/// A claim on one generation of a job.
pub(super) struct JetStreamClaim {
    client: Weak<Client>,
    key: JobKey,
}

impl JetStreamClaim {
    pub(super) fn new(client: &Arc<Client>, key: JobKey) -> Self {
        client.claims.add(key);
        Self { client: Arc::downgrade(client), key }
    }
}

impl ClaimGuard for JetStreamClaim {
    fn detach(&self) {
        if let Some(client) = self.client.upgrade() {
            client.claims.change(self.key, |claims| claims.detached = true);
        }
    }
}

impl Drop for JetStreamClaim {
    fn drop(&mut self) {
        if let Some(client) = self.client.upgrade() {
            client.claims.change(self.key, |claims| claims.count = claims.count.saturating_sub(1));
        }
    }
}

/// Records changes of claims until no more can come.
pub(super) async fn record_claims(client: Arc<Client>, mut changes: mpsc::UnboundedReceiver<ClaimChange>) {
    let mut failed = BTreeSet::new();
    loop {
        let mut batch = Vec::new();
        if failed.is_empty() {
            changes.recv_many(&mut batch, BATCH).await;
            if batch.is_empty() {
                return;
            }
        } else {
            drop(tokio::time::timeout(RETRY, changes.recv_many(&mut batch, BATCH)).await);
        }
        let mut keys = std::mem::take(&mut failed);
        let mut barriers = Vec::new();
        for change in batch {
            match change {
                ClaimChange::Changed(key) => drop(keys.insert(key)),
                ClaimChange::Barrier(sender) => barriers.push(sender),
            }
        }
        let recorded = stream::iter(keys).map(|key| {
            let client = &client;
            async move { (key, client.record_claim(key).await) }
        });
        let recorded: Vec<_> = recorded.buffer_unordered(CONCURRENT).collect().await;
        for (key, result) in recorded {
            if let Err(error) = result {
                tracing::warn!(%error, "a claim on a job is not recorded yet");
                failed.insert(key);
            }
        }
    }
}

impl Client {
    async fn record_claim(&self, key: JobKey) -> Result<(), UnavailableError> {
        let _shard = self.shard(key.id).await;
        let Some(claims) = self.claims.get(key) else {
            return Ok(());
        };
        let process = Claimant::Process(self.process);
        let recorded = self.change(key.id, |record| {
            if record.generation != key.generation || !record.is_active() {
                return false;
            }
            let mut changes = claims.detached && !record.is_detached;
            record.is_detached |= claims.detached;
            if claims.count == 0 && record.claimants.remove(&process) {
                changes = true;
                if !record.is_wanted() {
                    record.stop(StopSignal::Cancelled);
                }
            }
            changes
        });
        recorded.await?;
        self.claims.remove_unclaimed(key);
        Ok(())
    }
}
