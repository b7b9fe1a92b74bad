//! On what terms a listener serves.

use std::path::PathBuf;
use std::time::Duration;

use crate::http::proxy::ProxyNetwork;
use crate::process::config::ServeConfig;

/// What connections are given.
#[derive(Clone, Debug)]
pub(crate) struct Terms {
    /// Most that are open at once.
    pub connections: usize,
    /// How long a peer may take for a request's headers, for the handshake, for the next request.
    pub header: Duration,
    /// How long for the next byte of an answer.
    pub stall: Duration,
    /// The files of a certificate and its key, where it is served over TLS.
    pub tls: Option<[PathBuf; 2]>,
    /// Proxies, each of which may have all connections.
    pub proxies: Vec<ProxyNetwork>,
}

impl Terms {
    /// Where probes and metrics are all there is, and few ask for them.
    pub(crate) const fn of_probes() -> Self {
        let (header, stall) = (Duration::from_secs(10), Duration::from_secs(30));
        Self { connections: 256, header, stall, tls: None, proxies: Vec::new() }
    }
}

impl From<&ServeConfig> for Terms {
    fn from(config: &ServeConfig) -> Self {
        let files = config.tls_certificate.clone().zip(config.tls_key.clone());
        Self {
            connections: config.max_connections,
            header: Duration::from_secs(config.header_timeout),
            stall: Duration::from_secs(config.timeout),
            tls: files.map(<[PathBuf; 2]>::from),
            proxies: config.trusted_proxy.clone(),
        }
    }
}
