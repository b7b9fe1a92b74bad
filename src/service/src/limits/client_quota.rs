//! A limited number of permits, of which one client may take half.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use tokio::sync::{OwnedSemaphorePermit, Semaphore};

use crate::limits::error::LimitError;

/// One client may take all permits divided by this.
const CLIENT_PART: usize = 2;

/// A limited number of permits.
#[derive(Debug)]
pub(crate) struct Quota {
    permits: Arc<Semaphore>,
    count: usize,
    /// Most permits of one client.
    client_count: usize,
    by_client: Mutex<HashMap<String, usize>>,
}

/// Permits of a client, until they are dropped.
#[derive(Debug)]
pub(crate) struct QuotaPermit {
    quota: Arc<Quota>,
    permits: OwnedSemaphorePermit,
    /// `None` for a client that may take all permits.
    client: Option<String>,
}

impl Quota {
    /// This many permits, at least one.
    pub(crate) fn new(count: usize) -> Arc<Self> {
        let count = count.clamp(1, Semaphore::MAX_PERMITS.min(u32::MAX as usize));
        let (client_count, permits) = (count.div_ceil(CLIENT_PART), Arc::new(Semaphore::new(count)));
        Arc::new(Self { permits, count, client_count, by_client: Mutex::default() })
    }

    /// Takes a permit for a client. Fails if all permits, or those of the client, are taken.
    pub(crate) fn take(self: &Arc<Self>, client: Option<&str>) -> Result<QuotaPermit, LimitError> {
        self.take_many(client, 1)
    }

    /// Takes several permits, at most as many as one client may take: a larger request must not fail always.
    pub(crate) fn take_many(
        self: &Arc<Self>,
        client: Option<&str>,
        count: usize,
    ) -> Result<QuotaPermit, LimitError> {
        let mut permit = self.permit(client, self.acquire(0)?);
        permit.grow(count.min(self.client_count))?;
        Ok(permit)
    }

    /// Waits for a permit, before later calls of [`take`](Self::take). The client may then exceed its part.
    pub(crate) async fn wait(self: &Arc<Self>, client: Option<&str>) -> Option<QuotaPermit> {
        let taken = Arc::clone(&self.permits).acquire_owned().await.ok()?;
        let mut permit = self.permit(client, self.acquire(0).ok()?);
        permit.charge(1, usize::MAX).ok()?;
        permit.permits.merge(taken);
        Some(permit)
    }

    /// The number of permits.
    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// The number of permits that are not taken.
    pub(crate) fn left(&self) -> usize {
        self.permits.available_permits()
    }

    fn permit(self: &Arc<Self>, client: Option<&str>, permits: OwnedSemaphorePermit) -> QuotaPermit {
        QuotaPermit { quota: Arc::clone(self), permits, client: client.map(str::to_owned) }
    }

    fn acquire(&self, count: usize) -> Result<OwnedSemaphorePermit, LimitError> {
        let count = u32::try_from(count).map_err(|_| LimitError::Overloaded)?;
        Arc::clone(&self.permits).try_acquire_many_owned(count).map_err(|_| LimitError::Overloaded)
    }

    fn by_client(&self) -> MutexGuard<'_, HashMap<String, usize>> {
        self.by_client.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl QuotaPermit {
    /// Takes more permits.
    pub(crate) fn grow(&mut self, by: usize) -> Result<(), LimitError> {
        let more = self.quota.acquire(by)?;
        self.charge(by, self.quota.client_count)?;
        self.permits.merge(more);
        Ok(())
    }

    /// The number of permits.
    pub(crate) fn count(&self) -> usize {
        self.permits.num_permits()
    }

    fn charge(&self, count: usize, most: usize) -> Result<(), LimitError> {
        let Some(client) = &self.client else { return Ok(()) };
        let mut by_client = self.quota.by_client();
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

impl Drop for QuotaPermit {
    fn drop(&mut self) {
        let (Some(client), count) = (&self.client, self.count()) else { return };
        let mut by_client = self.quota.by_client();
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
    use super::Quota;

    #[tokio::test]
    async fn one_client_takes_at_most_half_of_the_permits() {
        let quota = Quota::new(4);
        let mut first = quota.take(Some("a")).unwrap();
        first.grow(1).unwrap();
        assert!(first.grow(1).is_err() && quota.take(Some("a")).is_err());
        let second = quota.take_many(Some("b"), 9).unwrap();
        assert_eq!((second.count(), quota.left()), (2, 0));
        assert!(quota.take(None).is_err());
        drop(first);
        assert!(quota.take(Some("b")).is_err());
        // A client that waits may exceed its part.
        let waited = quota.wait(Some("b")).await.unwrap();
        assert_eq!(quota.left(), 1);
        drop((second, waited));
        let here: Vec<_> = (0..4).map(|_| quota.take(None).unwrap()).collect();
        drop(here);
        assert_eq!((quota.left(), quota.by_client().len()), (4, 0));
    }
}
