//! The configuration of a listener.

use std::path::PathBuf;
use std::time::Duration;

use crate::http::proxy::ProxyNetwork;
use crate::process::config::ServeConfig;

/// How long the service waits for a client.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Timeouts {
    /// For the TLS handshake, the headers of a request, the next request, and the answer to a ping.
    pub header: Duration,
    /// While the client reads nothing of a response.
    pub stall: Duration,
}

/// The configuration.
#[derive(Clone, Debug)]
pub(crate) struct ListenerConfig {
    /// Maximum number of open connections.
    pub connections: usize,
    /// How long the service waits for a client.
    pub timeouts: Timeouts,
    /// Files of the certificate and its key; the listener then uses TLS.
    pub tls: Option<[PathBuf; 2]>,
    /// Proxies, each of which may have all connections.
    pub proxies: Vec<ProxyNetwork>,
}

impl ListenerConfig {
    /// For a worker, which serves only probes and metrics.
    pub(crate) const fn for_probes() -> Self {
        let timeouts = Timeouts { header: Duration::from_secs(10), stall: Duration::from_secs(30) };
        Self { connections: 256, timeouts, tls: None, proxies: Vec::new() }
    }
}

impl From<&ServeConfig> for ListenerConfig {
    fn from(config: &ServeConfig) -> Self {
        let files = config.tls_certificate.clone().zip(config.tls_key.clone());
        Self {
            connections: config.max_connections,
            timeouts: Timeouts {
                header: Duration::from_secs(config.header_timeout),
                stall: Duration::from_secs(config.timeout),
            },
            tls: files.map(<[PathBuf; 2]>::from),
            proxies: config.trusted_proxy.clone(),
        }
    }
}
