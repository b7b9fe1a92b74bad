//! The address of a client behind trusted proxies, from the header X-Forwarded-For.
//!
//! Each proxy appends the address from which it received the request. The service reads the list from its end as long
//! as the addresses belong to trusted proxies; anybody can have written the addresses before them. It ignores the
//! header Forwarded: a proxy that appends to one of the two headers passes the other on as the client sent it.

use std::net::{IpAddr, SocketAddr};

use axum::extract::{ConnectInfo, Request};
use axum::http::{HeaderMap, HeaderName};

use crate::http::proxy::ProxyNetwork;

const FORWARDED_FOR: HeaderName = HeaderName::from_static("x-forwarded-for");

/// Replaces the address of a trusted proxy by that of its client.
pub(crate) fn client_behind(
    proxies: Vec<ProxyNetwork>,
) -> impl Fn(Request) -> Request + Clone + Send + Sync + 'static {
    move |mut request| {
        if let Some(&ConnectInfo(peer)) = request.extensions().get::<ConnectInfo<SocketAddr>>()
            && let Some(client) = client(peer.ip(), request.headers(), &proxies)
        {
            // The port stays that of the proxy: the header has none.
            request.extensions_mut().insert(ConnectInfo(SocketAddr::new(client, peer.port())));
        }
        request
    }
}

/// The last address that is not a proxy, or the first address if all are proxies; `None` if the peer is the client.
fn client(peer: IpAddr, headers: &HeaderMap, proxies: &[ProxyNetwork]) -> Option<IpAddr> {
    let is_proxy = |address: &IpAddr| proxies.iter().any(|proxies| proxies.contains(address.to_canonical()));
    if !is_proxy(&peer) {
        return None;
    }
    let lists = headers.get_all(FORWARDED_FOR).iter().rev();
    let entries = lists.flat_map(|list| list.to_str().unwrap_or_default().rsplit(','));
    let mut first = None;
    // An entry that is no address ends the list: no trusted proxy wrote it.
    for address in entries.map_while(|entry| address(entry.trim())) {
        first = Some(address);
        if !is_proxy(&address) {
            break;
        }
    }
    first
}

/// An address; some proxies add the port.
fn address(entry: &str) -> Option<IpAddr> {
    let bare = entry.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')).unwrap_or(entry);
    bare.parse().ok().or_else(|| entry.parse::<SocketAddr>().ok().map(|address| address.ip()))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use axum::http::HeaderMap;

    use super::{FORWARDED_FOR, client};

    #[test]
    fn the_client_is_the_last_address_that_is_not_a_proxy() {
        let proxies = ["10.0.0.0/8", "2001:db8::1"].map(|network| network.parse().unwrap());
        for (peer, lists, expected) in [
            ("10.0.0.1", &["192.0.2.7"] as &[&str], Some("192.0.2.7")),
            ("::ffff:10.0.0.1", &["192.0.2.7"], Some("192.0.2.7")),
            ("2001:db8::1", &["2001:db8:1::7"], Some("2001:db8:1::7")),
            ("10.0.0.1", &["198.51.100.1, 192.0.2.7"], Some("192.0.2.7")),
            ("10.0.0.1", &["198.51.100.1, 192.0.2.7, 10.9.9.9"], Some("192.0.2.7")),
            ("10.0.0.1", &["198.51.100.1", "192.0.2.7,10.9.9.9"], Some("192.0.2.7")),
            ("10.0.0.1", &["192.0.2.7:4711"], Some("192.0.2.7")),
            ("10.0.0.1", &["[2001:db8:1::7]:4711"], Some("2001:db8:1::7")),
            ("10.0.0.1", &["10.7.7.7, 10.8.8.8"], Some("10.7.7.7")),
            ("10.0.0.1", &["192.0.2.7, unknown, 10.9.9.9"], Some("10.9.9.9")),
            ("10.0.0.1", &["192.0.2.7, unknown"], None),
            ("10.0.0.1", &[], None),
            ("203.0.113.9", &["192.0.2.7"], None),
        ] {
            let headers: HeaderMap =
                lists.iter().map(|list| (FORWARDED_FOR, list.parse().unwrap())).collect();
            let found = client(peer.parse().unwrap(), &headers, &proxies);
            assert_eq!(found, expected.map(|address| address.parse().unwrap()), "{peer} {lists:?}");
        }
    }
}
