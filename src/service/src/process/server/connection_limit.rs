//! The number of open connections: a total, and half of it for each client.

use std::net::IpAddr;
use std::sync::Arc;

use thiserror::Error;

use crate::http::proxy::ProxyNetwork;
use crate::limits::client_address::client_name;
use crate::limits::client_quota::{Quota, QuotaPermit};

/// Connections beyond the limit. The service answers only probes and metrics on them, so that a full service does not
/// look like a dead one.
pub(crate) const PROBE_CONNECTIONS: usize = 16;

/// Why a connection is rejected.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub(crate) enum ConnectionLimitError {
    /// Too many connections are open.
    #[error("rejecting connections: --max-connections are open")]
    Total,
    /// One client has too many connections.
    #[error("rejecting connections: one address has half of --max-connections")]
    Client,
}

/// The limit.
#[derive(Debug)]
pub(crate) struct ConnectionLimit {
    quota: Arc<Quota>,
    proxies: Vec<ProxyNetwork>,
}

impl ConnectionLimit {
    /// `total` connections. `proxies` have no limit of their own.
    pub(crate) fn new(total: usize, proxies: Vec<ProxyNetwork>) -> Self {
        Self { quota: Quota::new(total), proxies }
    }

    /// The number of connections.
    pub(crate) fn total(&self) -> usize {
        self.quota.count()
    }

    /// Counts a connection from `address` until the permit is dropped. A proxy and this machine may have all
    /// connections: they pass on the requests of many clients.
    pub(crate) fn take(&self, address: IpAddr) -> Result<QuotaPermit, ConnectionLimitError> {
        let canonical = address.to_canonical();
        let is_limited =
            !canonical.is_loopback() && !self.proxies.iter().any(|proxies| proxies.contains(canonical));
        let client = is_limited.then(|| client_name(address));
        self.quota.take(client.as_deref()).map_err(|_| match self.quota.left() {
            0 => ConnectionLimitError::Total,
            _ => ConnectionLimitError::Client,
        })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use super::{ConnectionLimit, ConnectionLimitError};

    #[test]
    fn a_client_has_half_of_the_connections_and_a_proxy_has_all() {
        let limit = ConnectionLimit::new(4, vec!["203.0.113.0/24".parse().unwrap()]);
        let take = |address: &str| limit.take(address.parse().unwrap());
        let first = ["2001:db8::1", "2001:db8::2"].map(|address| take(address).unwrap());
        assert_eq!(take("2001:db8::3").unwrap_err(), ConnectionLimitError::Client);
        let second = ["::ffff:192.0.2.1", "192.0.2.1"].map(|address| take(address).unwrap());
        assert_eq!(take("198.51.100.1").unwrap_err(), ConnectionLimitError::Total);
        drop((first, second));
        for address in ["127.0.0.1", "::1", "::ffff:127.0.0.1", "203.0.113.9"] {
            let all: Vec<_> = (0..4).map(|_| take(address).unwrap()).collect();
            assert_eq!(take(address).unwrap_err(), ConnectionLimitError::Total);
            drop(all);
        }
    }
}
