//! The API keys in use, which SIGHUP reloads.

use std::path::PathBuf;
use std::sync::{Arc, Weak};

use blake3::Hash;
use tokio::sync::watch;

use crate::limits::key::Key;
use crate::limits::keys_file;
use crate::limits::keys_file::{KeyHolder, KeyTable, KeysFileError};
use crate::limits::rate::Rate;

/// The keys of a file, from its last successful read.
pub(crate) struct Keys {
    path: PathBuf,
    rate: Option<Rate>,
    table: watch::Sender<KeyTable>,
}

impl Keys {
    /// Reads the file now, and again at each SIGHUP. `rate` applies to keys without a rate of their own.
    pub(crate) async fn open(path: PathBuf, rate: Option<Rate>) -> Result<Arc<Self>, KeysFileError> {
        let table = watch::Sender::new(read(path.clone(), rate).await?);
        let keys = Arc::new(Self { path, rate, table });
        tracing::info!(keys = keys.table.borrow().len(), "requests need an API key");
        #[cfg(unix)]
        drop(tokio::spawn(reread(Arc::downgrade(&keys))));
        Ok(keys)
    }

    /// Accepts a key that a client sent, if it is in the file.
    pub(crate) fn accept(&self, sent: &str) -> Option<AcceptedKey> {
        let hash = Key::hash_of(sent);
        let holder = self.table.borrow().get(&hash).cloned()?;
        Some(AcceptedKey { hash, holder, table: self.table.subscribe() })
    }

    /// Reads the file again. On failure the previous keys stay in use.
    pub(crate) async fn reload(&self) -> Result<(), KeysFileError> {
        self.table.send_replace(read(self.path.clone(), self.rate).await?);
        Ok(())
    }
}

/// A key that a client sent and that was in the file.
#[derive(Clone, Debug)]
pub(crate) struct AcceptedKey {
    hash: Hash,
    /// The holder when the client sent the key.
    pub(crate) holder: Arc<KeyHolder>,
    table: watch::Receiver<KeyTable>,
}

impl AcceptedKey {
    /// Returns when the file no longer has the key, or has it with another name or role.
    pub(crate) async fn revoked(mut self) {
        let Self { hash, holder, table } = &mut self;
        let is_same = |now: &KeyHolder| (&now.name, now.role) == (&holder.name, holder.role);
        let revoked = table.wait_for(|table| !table.get(hash).is_some_and(|now| is_same(now))).await;
        // An error means that the service has ended.
        drop(revoked);
    }
}

async fn read(path: PathBuf, rate: Option<Rate>) -> Result<KeyTable, KeysFileError> {
    let failed = KeysFileError::read_failed(&path);
    tokio::task::spawn_blocking(move || keys_file::read(&path, rate)).await.unwrap_or(Err(failed))
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
