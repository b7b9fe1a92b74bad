//! Limits the request rate of each client with token buckets.

use std::num::NonZeroU32;
use std::sync::Arc;
use std::time::Duration;

use governor::clock::{Clock, DefaultClock};
use governor::{DefaultDirectRateLimiter, Quota, RateLimiter};
use moka::policy::EvictionPolicy;
use moka::sync::Cache;
use tokio::time::sleep;

use crate::limits::error::LimitError;

/// Most addresses with a bucket. The least recently used buckets are dropped first.
const ADDRESSES: u64 = 100_000;

/// Requests per second, and the size of a burst.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rate {
    per_second: NonZeroU32,
    burst: NonZeroU32,
}

impl Rate {
    /// `None` for a rate of zero, which means no limit. By default a burst has the requests of a second.
    pub(crate) fn new(per_second: u32, burst: Option<NonZeroU32>) -> Option<Self> {
        let per_second = NonZeroU32::new(per_second)?;
        Some(Self { per_second, burst: burst.unwrap_or(per_second) })
    }
}

/// The token bucket of one client.
#[derive(Debug)]
pub(crate) struct TokenBucket(DefaultDirectRateLimiter);

impl TokenBucket {
    pub(crate) fn new(rate: Rate) -> Self {
        Self(RateLimiter::direct(Quota::per_second(rate.per_second).allow_burst(rate.burst)))
    }

    /// Takes the token of a request.
    pub(crate) fn take(&self) -> Result<(), LimitError> {
        self.0.check().map_err(|not_until| {
            let wait = not_until.wait_time_from(DefaultClock::default().now());
            LimitError::TooManyRequests(seconds(wait))
        })
    }
}

impl TokenBucket {
    /// Waits for a token, and takes it.
    async fn wait(&self) {
        while let Err(not_until) = self.0.check() {
            sleep(not_until.wait_time_from(DefaultClock::default().now())).await;
        }
    }
}

/// Charges the rows of a table to its client: a token for as many rows as a batch in JSON may have. A client that has
/// none left waits.
#[derive(Debug)]
pub(crate) struct RowCharge {
    bucket: Option<Arc<TokenBucket>>,
    rows_per_token: usize,
    /// Rows that are paid for.
    paid: usize,
}

impl RowCharge {
    /// The token of the request pays for the first rows. Without a bucket there is no limit.
    pub(crate) fn new(bucket: Option<Arc<TokenBucket>>, rows_per_token: usize) -> Self {
        let rows_per_token = rows_per_token.max(1);
        Self { bucket, rows_per_token, paid: rows_per_token }
    }

    /// Charges some rows.
    pub(crate) async fn charge(&mut self, rows: usize) {
        let Some(bucket) = &self.bucket else { return };
        while self.paid < rows {
            bucket.wait().await;
            self.paid += self.rows_per_token;
        }
        self.paid -= rows;
    }
}

/// Whole seconds until there is a token.
fn seconds(wait: Duration) -> u64 {
    wait.as_secs() + u64::from(wait.subsec_nanos() > 0)
}

/// The buckets of clients without a key, by address.
#[derive(Clone, Debug)]
pub(crate) struct AddressBuckets {
    rate: Rate,
    buckets: Cache<String, Arc<TokenBucket>>,
}

impl AddressBuckets {
    pub(crate) fn new(rate: Rate) -> Self {
        // The default policy does not admit new entries to a full cache, so new addresses would have no limit.
        let buckets = Cache::builder().max_capacity(ADDRESSES).eviction_policy(EvictionPolicy::lru());
        Self { rate, buckets: buckets.build() }
    }

    /// The bucket of an address.
    pub(crate) fn bucket(&self, address: &str) -> Arc<TokenBucket> {
        self.buckets.get_with_by_ref(address, || Arc::new(TokenBucket::new(self.rate)))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use std::num::NonZeroU32;
    use std::sync::Arc;

    use futures_util::FutureExt;

    use super::{Rate, RowCharge, TokenBucket};

    #[tokio::test]
    async fn rows_take_the_tokens_of_as_many_batches() {
        let rate = Rate::new(1, NonZeroU32::new(2)).unwrap();
        let bucket = Arc::new(TokenBucket::new(rate));
        let mut charge = RowCharge::new(Some(Arc::clone(&bucket)), 10);
        assert!(charge.charge(10).now_or_never().is_some(), "the request has paid");
        assert!(charge.charge(15).now_or_never().is_some(), "two tokens");
        assert!(charge.charge(5).now_or_never().is_some(), "the rest of the second one");
        assert!(charge.charge(1).now_or_never().is_none() && bucket.take().is_err());
        assert!(RowCharge::new(None, 10).charge(1_000_000).now_or_never().is_some());
    }
}
