//! Warnings for the operator if other machines can reach a listener.

use std::net::IpAddr;

/// Warns if other machines can reach the service without a key or without encryption.
pub(crate) fn warn_if_open(listen: IpAddr, has_keys: bool, has_tls: bool) {
    if listen.to_canonical().is_loopback() {
        return;
    }
    if !has_keys {
        tracing::warn!("ANYBODY who can connect to {listen} can use this service: it requires no API key");
    }
    if !has_tls {
        tracing::warn!(
            "traffic on {listen} is not encrypted, API keys included: set --tls-certificate and --tls-key, or use a \
             proxy with TLS"
        );
    }
}

/// Warns if other machines can reach the probes and metrics of a worker, which need no key and use no TLS.
pub(crate) fn warn_if_probes_are_open(listen: IpAddr) {
    if !listen.to_canonical().is_loopback() {
        tracing::warn!(
            "ANYBODY who can connect to {listen} can read this worker's probes and metrics, without encryption: \
             restrict access to the monitoring system"
        );
    }
}

#[cfg(test)]
mod tests {
    use std::net::{IpAddr, Ipv4Addr, Ipv6Addr};

    use super::{warn_if_open, warn_if_probes_are_open};
    use crate::telemetry::captured_log::CapturedLog;

    /// The number of warnings that `warn` logs.
    fn warnings(warn: impl Fn()) -> usize {
        let log = CapturedLog::begin();
        warn();
        log.text().lines().filter(|line| line.contains("\"WARN\"")).count()
    }

    #[test]
    fn listeners_that_other_machines_can_reach_cause_warnings() {
        for listen in [IpAddr::V4(Ipv4Addr::UNSPECIFIED), IpAddr::V6(Ipv6Addr::UNSPECIFIED)] {
            assert_eq!(warnings(|| warn_if_probes_are_open(listen)), 1);
            assert_eq!(warnings(|| warn_if_open(listen, false, false)), 2);
            assert_eq!(warnings(|| warn_if_open(listen, true, true)), 0);
        }
        for listen in [IpAddr::V4(Ipv4Addr::LOCALHOST), Ipv4Addr::LOCALHOST.to_ipv6_mapped().into()] {
            assert_eq!(warnings(|| warn_if_probes_are_open(listen)), 0);
            assert_eq!(warnings(|| warn_if_open(listen, false, false)), 0);
        }
    }
}
