//! The address on which the service listens.

use std::fmt;
use std::io;
use std::net::{Ipv4Addr, Ipv6Addr, SocketAddr};
use std::str::FromStr;

use tokio::net::TcpListener;

/// The host name that stands for both loopback addresses.
const LOOPBACK: &str = "localhost";

/// One address and port, or a port of both loopback addresses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Listen {
    /// This address.
    Address(SocketAddr),
    /// This port of 127.0.0.1 and of ::1.
    Loopback(u16),
}

impl Listen {
    /// Whether only this computer can connect.
    pub(crate) fn is_loopback(self) -> bool {
        match self {
            Self::Address(address) => address.ip().to_canonical().is_loopback(),
            Self::Loopback(_) => true,
        }
    }

    /// Opens the listeners: two for a port of both loopback addresses, or one if the system has no ::1.
    pub(crate) async fn bind(self) -> io::Result<Vec<TcpListener>> {
        let port = match self {
            Self::Address(address) => return Ok(vec![TcpListener::bind(address).await?]),
            Self::Loopback(port) => port,
        };
        let first = TcpListener::bind((Ipv4Addr::LOCALHOST, port)).await?;
        let port = first.local_addr()?.port();
        match TcpListener::bind((Ipv6Addr::LOCALHOST, port)).await {
            Ok(second) => Ok(vec![first, second]),
            // Another program has the port there. Clients of localhost might reach that program or this service.
            Err(error) if error.kind() == io::ErrorKind::AddrInUse => Err(error),
            Err(error) => {
                tracing::debug!(%error, "this system has no ::1");
                Ok(vec![first])
            }
        }
    }
}

impl FromStr for Listen {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if let Some(port) = text.strip_prefix(LOOPBACK).and_then(|rest| rest.strip_prefix(':')) {
            let port = port.parse().map_err(|_| format!("{port:?} is not a valid port"))?;
            return Ok(Self::Loopback(port));
        }
        text.parse().map(Self::Address).map_err(|_| {
            "must be an address and a port such as 0.0.0.0:8080 or [::]:8080, or localhost:8080 for 127.0.0.1 and ::1"
                .to_owned()
        })
    }
}

impl fmt::Display for Listen {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Address(address) => address.fmt(f),
            Self::Loopback(port) => write!(f, "{LOOPBACK}:{port}"),
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use std::net::Ipv6Addr;

    use tokio::net::{TcpListener, TcpStream};

    use super::Listen;

    #[tokio::test]
    async fn localhost_listens_on_both_loopback_addresses() {
        let listeners = Listen::Loopback(0).bind().await.unwrap();
        let port = listeners[0].local_addr().unwrap().port();
        assert!(TcpStream::connect(("127.0.0.1", port)).await.is_ok());
        let has_ipv6 = TcpListener::bind((Ipv6Addr::LOCALHOST, 0)).await.is_ok();
        assert_eq!(TcpStream::connect((Ipv6Addr::LOCALHOST, port)).await.is_ok(), has_ipv6);
        assert!(Listen::Loopback(port).bind().await.is_err(), "the port is taken");
    }

    #[test]
    fn addresses_and_localhost_are_valid() {
        for (text, loopback) in [
            ("localhost:8080", Some(true)),
            ("127.0.0.1:0", Some(true)),
            ("[::1]:8080", Some(true)),
            ("0.0.0.0:8080", Some(false)),
            ("[::]:8080", Some(false)),
            ("localhost", None),
            ("localhost:99999", None),
            ("nowhere:80", None),
            ("127.0.0.1", None),
        ] {
            let read = text.parse::<Listen>().ok();
            assert_eq!(read.map(Listen::is_loopback), loopback, "{text}");
            assert!(read.is_none_or(|read| read.to_string() == text), "{text}");
        }
    }
}
