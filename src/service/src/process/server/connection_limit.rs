//! Places for connections: so many in all, and no address takes them all.

use std::collections::HashMap;
use std::fmt;
use std::net::{IpAddr, Ipv6Addr};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use crate::http::proxy::ProxyNetwork;

/// The part of all places that one address may have.
const SHARE: usize = 2;

/// Places above all others, in which only how the service fares is answered: who asks that must not take a full service
/// for a dead one.
pub(crate) const SPARE: usize = 16;

/// Why there is no place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Full {
    /// All are taken.
    All,
    /// This address has its share.
    Share,
}

impl fmt::Display for Full {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::All => "rejecting connections: --max-connections are open",
            Self::Share => "rejecting connections: one address has half of --max-connections",
        })
    }
}

/// The places.
#[derive(Debug)]
pub(crate) struct Places {
    all: usize,
    proxies: Vec<ProxyNetwork>,
    taken: Mutex<Taken>,
}

#[derive(Debug, Default)]
struct Taken {
    all: usize,
    by_address: HashMap<IpAddr, usize>,
}

/// A place, until it is dropped.
#[derive(Debug)]
pub(crate) struct Place {
    places: Arc<Places>,
    address: IpAddr,
}

impl Places {
    /// So many places, any number of which each of these proxies may have.
    pub(crate) fn new(all: usize, proxies: Vec<ProxyNetwork>) -> Arc<Self> {
        Arc::new(Self { all, proxies, taken: Mutex::default() })
    }

    /// How many there are.
    pub(crate) fn count(&self) -> usize {
        self.all
    }

    /// Takes a place for a connection from this address. Proxies have no share, nor has this machine itself: what they
    /// send comes from everybody.
    pub(crate) fn take(self: &Arc<Self>, address: IpAddr) -> Result<Place, Full> {
        let is_proxy = self.proxies.iter().any(|proxies| proxies.contains(address.to_canonical()));
        let address = household(address);
        let share = if is_proxy || address.is_loopback() { self.all } else { self.all.div_ceil(SHARE) };
        let mut taken = self.taken();
        if taken.all >= self.all {
            return Err(Full::All);
        }
        let here = taken.by_address.entry(address).or_default();
        if *here >= share {
            return Err(Full::Share);
        }
        *here += 1;
        taken.all += 1;
        Ok(Place { places: Arc::clone(self), address })
    }

    fn taken(&self) -> MutexGuard<'_, Taken> {
        self.taken.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        let mut taken = self.places.taken();
        taken.all -= 1;
        if let Some(here) = taken.by_address.get_mut(&self.address) {
            *here -= 1;
            if *here == 0 {
                taken.by_address.remove(&self.address);
            }
        }
    }
}

/// Who has an address of version 6 has the 2^64 addresses around it.
fn household(address: IpAddr) -> IpAddr {
    match address.to_canonical() {
        IpAddr::V6(v6) if !v6.is_loopback() => {
            let [a, b, c, d, ..] = v6.segments();
            Ipv6Addr::new(a, b, c, d, 0, 0, 0, 0).into()
        }
        other => other,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use super::{Full, Places};

    #[test]
    fn no_address_takes_all() {
        let places = Places::new(4, vec!["203.0.113.0/24".parse().unwrap()]);
        let ip = |text: &str| text.parse().unwrap();
        let first = [ip("2001:db8::1"), ip("2001:db8::2")].map(|address| places.take(address).unwrap());
        assert_eq!(places.take(ip("2001:db8::3")).unwrap_err(), Full::Share);
        let second = [ip("::ffff:192.0.2.1"), ip("192.0.2.1")].map(|address| places.take(address).unwrap());
        assert_eq!(places.take(ip("198.51.100.1")).unwrap_err(), Full::All);
        drop(first);
        assert_eq!(places.take(ip("192.0.2.1")).unwrap_err(), Full::Share);
        let again = places.take(ip("2001:db8::3")).unwrap();
        drop((second, again));
        let here: Vec<_> = (0..4).map(|_| places.take(ip("127.0.0.1")).unwrap()).collect();
        assert_eq!(places.take(ip("::1")).unwrap_err(), Full::All);
        drop(here);
        let proxied: Vec<_> = (0..4).map(|_| places.take(ip("203.0.113.9")).unwrap()).collect();
        drop(proxied);
        assert!(places.taken().by_address.is_empty());
    }
}
