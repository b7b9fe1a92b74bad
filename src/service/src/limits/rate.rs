//! How fast one client may ask: token buckets.

use std::num::NonZeroU32;
use std::sync::Arc;
use std::time::Duration;

use governor::clock::{Clock, DefaultClock};
use governor::{DefaultDirectRateLimiter, Quota, RateLimiter};
use moka::policy::EvictionPolicy;
use moka::sync::Cache;

use crate::limits::error::LimitError;

/// Most addresses that are remembered: the longest silent are forgotten first, and may begin anew.
const ADDRESSES: u64 = 100_000;

/// Requests a second, and how many at once.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rate {
    second: NonZeroU32,
    burst: NonZeroU32,
}

impl Rate {
    /// Nothing for no limit; without a burst it is a second's requests.
    pub(crate) fn new(second: u32, burst: Option<NonZeroU32>) -> Option<Self> {
        let second = NonZeroU32::new(second)?;
        Some(Self { second, burst: burst.unwrap_or(second) })
    }
}

/// One client's bucket.
#[derive(Debug)]
pub(crate) struct Bucket(DefaultDirectRateLimiter);

impl Bucket {
    pub(crate) fn new(rate: Rate) -> Self {
        Self(RateLimiter::direct(Quota::per_second(rate.second).allow_burst(rate.burst)))
    }

    /// Takes a request's token.
    pub(crate) fn take(&self) -> Result<(), LimitError> {
        self.0.check().map_err(|not_until| {
            let wait = not_until.wait_time_from(DefaultClock::default().now());
            LimitError::TooManyRequests(seconds(wait))
        })
    }
}

/// Whole seconds after which there is a token.
fn seconds(wait: Duration) -> u64 {
    wait.as_secs() + u64::from(wait.subsec_nanos() > 0)
}

/// The buckets of all addresses.
#[derive(Clone, Debug)]
pub(crate) struct Addresses {
    rate: Rate,
    buckets: Cache<String, Arc<Bucket>>,
}

impl Addresses {
    pub(crate) fn new(rate: Rate) -> Self {
        // Not the default policy: that one refuses newcomers, which would have no limit then.
        let buckets = Cache::builder().max_capacity(ADDRESSES).eviction_policy(EvictionPolicy::lru());
        Self { rate, buckets: buckets.build() }
    }

    /// Takes a token of an address.
    pub(crate) fn take(&self, address: &str) -> Result<(), LimitError> {
        self.buckets.get_with_by_ref(address, || Arc::new(Bucket::new(self.rate))).take()
    }
}
