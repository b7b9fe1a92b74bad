//! What an operator should know before others can reach the service.

use std::net::IpAddr;

/// Warns of a service that others can reach and that asks nobody who they are, or in clear.
pub(super) fn warn_if_open(listen: IpAddr, has_keys: bool, has_tls: bool) {
    if listen.to_canonical().is_loopback() {
        return;
    }
    if !has_keys {
        tracing::warn!("ANYBODY who reaches {listen} can use this service: it asks for no keys");
    }
    if !has_tls {
        tracing::warn!(
            "what is sent to {listen} and back travels in clear, keys included: give --tls-certificate and --tls-key, \
             or put a proxy with TLS before it"
        );
    }
}
