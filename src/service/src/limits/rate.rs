//! Limits the request rate of each client with token buckets.

use std::num::NonZeroU32;
use std::sync::Arc;
use std::time::Duration;

use governor::clock::{Clock, DefaultClock};
use governor::{DefaultDirectRateLimiter, Quota, RateLimiter};
use moka::policy::EvictionPolicy;
use moka::sync::Cache;

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

    /// Takes a token of an address.
    pub(crate) fn take(&self, address: &str) -> Result<(), LimitError> {
        self.buckets.get_with_by_ref(address, || Arc::new(TokenBucket::new(self.rate))).take()
    }
}
