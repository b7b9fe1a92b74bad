//! Settings of a service behind a proxy: its path and host names there, and the proxies that it trusts.

use std::fmt;
use std::net::IpAddr;
use std::str::FromStr;

use ipnet::IpNet;

/// The path under which the proxy publishes the service: empty, or `/` and segments, without a slash at the end.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct BasePath(String);

impl BasePath {
    /// The path.
    pub(crate) fn as_str(&self) -> &str {
        &self.0
    }
}

impl FromStr for BasePath {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let path = text.strip_suffix('/').unwrap_or(text);
        let is_plain = |c: char| c.is_ascii_alphanumeric() || "-._~".contains(c);
        let is_segment = |segment: &str| {
            !segment.is_empty() && ![".", ".."].contains(&segment) && segment.chars().all(is_plain)
        };
        let is_path = match path.strip_prefix('/') {
            Some(segments) => segments.split('/').all(is_segment),
            None => path.is_empty(),
        };
        if is_path {
            Ok(Self(path.to_owned()))
        } else {
            Err("must be a path such as /verne, of letters, digits and -._~".to_owned())
        }
    }
}

impl fmt::Display for BasePath {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// The addresses of proxies: a network, or one address.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ProxyNetwork(IpNet);

impl ProxyNetwork {
    /// Whether the network contains the address, which is in canonical form.
    pub(crate) fn contains(&self, address: IpAddr) -> bool {
        self.0.contains(&address)
    }
}

impl FromStr for ProxyNetwork {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let network = text.parse::<IpNet>().or_else(|_| text.parse::<IpAddr>().map(IpNet::from));
        network.map(Self).map_err(|_| "must be a network such as 10.0.0.0/8, or an address".to_owned())
    }
}

/// A name in the header Host, in lowercase and without a port, or every name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HostName(String);

impl HostName {
    /// Every name.
    const ANY: &str = "*";

    /// Whether it stands for every name.
    pub(crate) fn is_any(&self) -> bool {
        self.0 == Self::ANY
    }

    /// The name.
    pub(crate) fn as_str(&self) -> &str {
        &self.0
    }
}

impl FromStr for HostName {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let is_name =
            !text.is_empty() && text.chars().all(|c| c.is_ascii_alphanumeric() || "-._".contains(c));
        if is_name || text == Self::ANY {
            Ok(Self(text.to_ascii_lowercase()))
        } else {
            Err("must be a host name such as verne.example.org, without scheme and port, or *".to_owned())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{BasePath, HostName, ProxyNetwork};

    #[test]
    fn base_paths_have_plain_segments() {
        for (text, path) in [
            ("/verne", Some("/verne")),
            ("/tools/verne-2/", Some("/tools/verne-2")),
            ("/", Some("")),
            ("", Some("")),
            ("verne", None),
            ("//verne", None),
            ("/a//b", None),
            ("/a/../b", None),
            ("/a b", None),
            ("/a?b", None),
            ("https://example.org/verne", None),
        ] {
            assert_eq!(text.parse::<BasePath>().ok().as_ref().map(BasePath::as_str), path, "{text}");
        }
    }

    #[test]
    fn networks_and_host_names_are_checked() {
        for text in ["10.0.0.0/8", "10.1.2.3", "2001:db8::/32", "::1"] {
            assert!(text.parse::<ProxyNetwork>().is_ok(), "{text}");
        }
        for text in ["10.0.0.0/33", "proxy", "", "10.0.0.1:80"] {
            assert!(text.parse::<ProxyNetwork>().is_err(), "{text}");
        }
        for text in ["verne.example.org", "Verne", "*"] {
            assert!(text.parse::<HostName>().is_ok(), "{text}");
        }
        for text in ["", "verne:8080", "https://verne", "a/b", "[::1]"] {
            assert!(text.parse::<HostName>().is_err(), "{text}");
        }
    }
}
