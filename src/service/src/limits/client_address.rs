//! Names of clients that have no key: their addresses.

use std::net::IpAddr;

/// The name of the client at an address. An IPv6 subscriber has a whole /64 network, so that network is one client.
pub(crate) fn client_name(address: IpAddr) -> String {
    match address.to_canonical() {
        IpAddr::V4(address) => address.to_string(),
        IpAddr::V6(address) => {
            let [a, b, c, d, ..] = address.segments();
            format!("{a:x}:{b:x}:{c:x}:{d:x}::/64")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::client_name;

    #[test]
    fn an_ipv6_network_is_one_client() {
        let name = |address: &str| address.parse().map(client_name);
        assert_eq!(name("2001:db8:1:2:3::4"), name("2001:db8:1:2:ffff::1"));
        assert_ne!(name("2001:db8:1:2::1"), name("2001:db8:1:3::1"));
        assert_eq!(name("::ffff:10.0.0.1"), name("10.0.0.1"));
    }
}
