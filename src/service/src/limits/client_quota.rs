//! Shares of what is bounded: so many in all, and no client takes them all.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use tokio::sync::{OwnedSemaphorePermit, Semaphore};

use crate::limits::error::LimitError;

/// The part of all shares that one client may have.
const PART: usize = 2;

/// So many shares.
#[derive(Debug)]
pub(crate) struct Shares {
    all: Arc<Semaphore>,
    count: usize,
    /// Most that one client has.
    part: usize,
    by_client: Mutex<HashMap<String, usize>>,
}

/// Shares that are taken, until they are dropped.
#[derive(Debug)]
pub(crate) struct Share {
    shares: Arc<Shares>,
    taken: OwnedSemaphorePermit,
    /// Nobody where no client is bounded.
    client: Option<String>,
}

impl Shares {
    /// So many, at least one.
    pub(crate) fn new(all: usize) -> Arc<Self> {
        let count = all.clamp(1, Semaphore::MAX_PERMITS.min(u32::MAX as usize));
        let (part, all) = (count.div_ceil(PART), Arc::new(Semaphore::new(count)));
        Arc::new(Self { all, count, part, by_client: Mutex::default() })
    }

    /// One for a client, if it and all together have not too many.
    pub(crate) fn take(self: &Arc<Self>, client: Option<&str>) -> Result<Share, LimitError> {
        self.take_many(client, 1)
    }

    /// Several; no more than one client may have, so that what is larger still has a way.
    pub(crate) fn take_many(
        self: &Arc<Self>,
        client: Option<&str>,
        count: usize,
    ) -> Result<Share, LimitError> {
        let mut share = self.owned_by(client, self.permits(0)?);
        share.grow(count.min(self.part))?;
        Ok(share)
    }

    /// Waits for one, before those that come anew; the client may have too many then.
    pub(crate) async fn wait(self: &Arc<Self>, client: Option<&str>) -> Option<Share> {
        let taken = Arc::clone(&self.all).acquire_owned().await.ok()?;
        let mut share = self.owned_by(client, self.permits(0).ok()?);
        share.charge(1, usize::MAX).ok()?;
        share.taken.merge(taken);
        Some(share)
    }

    /// How many there are.
    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// How many are left.
    pub(crate) fn left(&self) -> usize {
        self.all.available_permits()
    }

    fn owned_by(self: &Arc<Self>, client: Option<&str>, taken: OwnedSemaphorePermit) -> Share {
        Share { shares: Arc::clone(self), taken, client: client.map(str::to_owned) }
    }

    fn permits(&self, count: usize) -> Result<OwnedSemaphorePermit, LimitError> {
        let count = u32::try_from(count).map_err(|_| LimitError::Overloaded)?;
        Arc::clone(&self.all).try_acquire_many_owned(count).map_err(|_| LimitError::Overloaded)
    }

    fn by_client(&self) -> MutexGuard<'_, HashMap<String, usize>> {
        self.by_client.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Share {
    /// Takes so many more.
    pub(crate) fn grow(&mut self, by: usize) -> Result<(), LimitError> {
        let more = self.shares.permits(by)?;
        self.charge(by, self.shares.part)?;
        self.taken.merge(more);
        Ok(())
    }

    /// How many it is.
    pub(crate) fn count(&self) -> usize {
        self.taken.num_permits()
    }

    fn charge(&self, count: usize, most: usize) -> Result<(), LimitError> {
        let Some(client) = &self.client else { return Ok(()) };
        let mut by_client = self.shares.by_client();
        let has = by_client.get(client).copied().unwrap_or_default() + count;
        if has > most {
            return Err(LimitError::Overloaded);
        }
        match by_client.get_mut(client) {
            Some(had) => *had = has,
            None => drop(by_client.insert(client.clone(), has)),
        }
        Ok(())
    }
}

impl Drop for Share {
    fn drop(&mut self) {
        let (Some(client), count) = (&self.client, self.count()) else { return };
        let mut by_client = self.shares.by_client();
        if let Some(has) = by_client.get_mut(client) {
            *has -= count;
            if *has == 0 {
                by_client.remove(client);
            }
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use super::Shares;

    #[tokio::test]
    async fn no_client_takes_all() {
        let shares = Shares::new(4);
        let mut first = shares.take(Some("a")).unwrap();
        first.grow(1).unwrap();
        assert!(first.grow(1).is_err() && shares.take(Some("a")).is_err());
        let second = shares.take_many(Some("b"), 9).unwrap();
        assert_eq!((second.count(), shares.left()), (2, 0));
        assert!(shares.take(None).is_err());
        drop(first);
        assert!(shares.take(Some("b")).is_err());
        // Who has waited is not turned away.
        let waited = shares.wait(Some("b")).await.unwrap();
        assert_eq!(shares.left(), 1);
        drop((second, waited));
        let here: Vec<_> = (0..4).map(|_| shares.take(None).unwrap()).collect();
        drop(here);
        assert_eq!((shares.left(), shares.by_client().len()), (4, 0));
    }
}
