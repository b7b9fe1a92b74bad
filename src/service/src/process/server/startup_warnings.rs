//! What an operator should know before others can reach the service.

use std::net::IpAddr;

/// Warns of a service that others can reach and that asks nobody who they are, or in clear.
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

/// Warns of probes and metrics that others can read: nobody is asked who they are, and there is no TLS.
pub(crate) fn warn_of_probes(listen: IpAddr) {
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

    use super::{warn_if_open, warn_of_probes};
    use crate::telemetry::logged::Logged;

    /// What is warned of by `warn`.
    fn warned(warn: impl Fn()) -> usize {
        let logged = Logged::begin();
        warn();
        logged.text().lines().filter(|line| line.contains("\"WARN\"")).count()
    }

    #[test]
    fn what_others_can_reach_is_warned_of() {
        for listen in [IpAddr::V4(Ipv4Addr::UNSPECIFIED), IpAddr::V6(Ipv6Addr::UNSPECIFIED)] {
            assert_eq!(warned(|| warn_of_probes(listen)), 1);
            assert_eq!(warned(|| warn_if_open(listen, false, false)), 2);
            assert_eq!(warned(|| warn_if_open(listen, true, true)), 0);
        }
        for listen in [IpAddr::V4(Ipv4Addr::LOCALHOST), Ipv4Addr::LOCALHOST.to_ipv6_mapped().into()] {
            assert_eq!(warned(|| warn_of_probes(listen)), 0);
            assert_eq!(warned(|| warn_if_open(listen, false, false)), 0);
        }
    }
}
