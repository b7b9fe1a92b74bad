//! The keys in force.

use std::path::PathBuf;
use std::sync::{Arc, Weak};

use blake3::Hash;
use tokio::sync::watch;

use crate::limits::key::Key;
use crate::limits::keys_file;
use crate::limits::keys_file::{BadKeys, Holder, Table};
use crate::limits::rate::Rate;

/// The keys of a file, as it was when it was last read well.
pub(crate) struct Keys {
    path: PathBuf,
    rate: Option<Rate>,
    table: watch::Sender<Table>,
}

impl Keys {
    /// Reads the file now, and again at each SIGHUP; `rate` limits the keys that have none of their own.
    pub(crate) async fn open(path: PathBuf, rate: Option<Rate>) -> Result<Arc<Self>, BadKeys> {
        let table = watch::Sender::new(read(path.clone(), rate).await?);
        let keys = Arc::new(Self { path, rate, table });
        tracing::info!(keys = keys.table.borrow().len(), "requests need an API key");
        #[cfg(unix)]
        drop(tokio::spawn(reread(Arc::downgrade(&keys))));
        Ok(keys)
    }

    /// Whose key was sent.
    pub(crate) fn holder(&self, sent: &str) -> Option<Pass> {
        let hash = Key::hash_of(sent);
        let holder = self.table.borrow().get(&hash).cloned()?;
        Some(Pass { hash, holder, table: self.table.subscribe() })
    }

    /// Reads the file again; if it cannot be used, all stays as it is.
    pub(crate) async fn reload(&self) -> Result<(), BadKeys> {
        self.table.send_replace(read(self.path.clone(), self.rate).await?);
        Ok(())
    }
}

/// A key that was sent and is known, for as long as it is.
#[derive(Clone, Debug)]
pub(crate) struct Pass {
    hash: Hash,
    /// Whose it was when it was sent.
    pub(crate) holder: Arc<Holder>,
    table: watch::Receiver<Table>,
}

impl Pass {
    /// Returns when the key is no longer in the file, or has another name or role there.
    pub(crate) async fn revoked(mut self) {
        let Self { hash, holder, table } = &mut self;
        let is_same = |now: &Holder| (&now.name, now.role) == (&holder.name, holder.role);
        let revoked = table.wait_for(|table| !table.get(hash).is_some_and(|now| is_same(now))).await;
        // Where all keys have gone the service has.
        drop(revoked);
    }
}

async fn read(path: PathBuf, rate: Option<Rate>) -> Result<Table, BadKeys> {
    let lost = BadKeys::lost(&path);
    tokio::task::spawn_blocking(move || keys_file::read(&path, rate)).await.unwrap_or(Err(lost))
}

#[cfg(unix)]
async fn reread(keys: Weak<Keys>) {
    use tokio::signal::unix::{SignalKind, signal};
    let Ok(mut hangups) = signal(SignalKind::hangup()) else { return };
    while hangups.recv().await.is_some() {
        let Some(keys) = keys.upgrade() else { return };
        match keys.reload().await {
            Ok(()) => tracing::info!(keys = keys.table.borrow().len(), "reloaded the API keys"),
            Err(error) => {
                tracing::error!(%error, "cannot reload the API keys; the previous ones stay in use");
            }
        }
    }
}
