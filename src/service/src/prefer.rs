//! How long a client is willing to wait: the header Prefer (RFC 7240), and who the client is.

use std::convert::Infallible;
use std::net::{IpAddr, SocketAddr};
use std::time::Duration;

use axum::extract::{ConnectInfo, FromRequestParts};
use axum::http::request::Parts;
use axum::http::{HeaderMap, HeaderName, HeaderValue, Response};

use crate::obtain::Patience;
use crate::state::Shared;

const PREFER: HeaderName = HeaderName::from_static("prefer");
const PREFERENCE_APPLIED: HeaderName = HeaderName::from_static("preference-applied");

/// What a request says about waiting.
#[derive(Debug)]
pub(crate) struct Prefer {
    /// Who waits, and how long.
    pub patience: Patience,
    applied: Option<String>,
}

impl FromRequestParts<Shared> for Prefer {
    type Rejection = Infallible;

    async fn from_request_parts(parts: &mut Parts, state: &Shared) -> Result<Self, Infallible> {
        let address = parts.extensions.get::<ConnectInfo<SocketAddr>>();
        let client = address.map_or_else(|| "local".to_owned(), |ConnectInfo(peer)| network(peer.ip()));
        let preferred = preferred(&parts.headers);
        let wait = preferred.unwrap_or(state.limits.wait).min(state.limits.longest_wait);
        let applied = preferred.map(|_| match wait.as_secs() {
            0 => "respond-async".to_owned(),
            seconds => format!("wait={seconds}"),
        });
        Ok(Self { patience: Patience { client, wait }, applied })
    }
}

impl Prefer {
    /// Says which preference was followed.
    pub(crate) fn tell<B>(self, response: &mut Response<B>) {
        if let Some(value) = self.applied.and_then(|applied| HeaderValue::from_str(&applied).ok()) {
            response.headers_mut().insert(PREFERENCE_APPLIED, value);
        }
    }
}

/// One client of the queue: an address, or the network that an IPv6 subscriber has for himself.
fn network(address: IpAddr) -> String {
    match address.to_canonical() {
        IpAddr::V4(address) => address.to_string(),
        IpAddr::V6(address) => {
            let [a, b, c, d, ..] = address.segments();
            format!("{a:x}:{b:x}:{c:x}:{d:x}::/64")
        }
    }
}

/// The wait that is asked for. Both preferences together: `respond-async` once `wait` has passed.
fn preferred(headers: &HeaderMap) -> Option<Duration> {
    let values = headers.get_all(PREFER).iter().filter_map(|value| value.to_str().ok());
    let mut preferred = None;
    for preference in values.flat_map(|value| value.split(',')) {
        let preference = preference.split(';').next().unwrap_or_default().trim();
        match preference.split_once('=') {
            None if preference.eq_ignore_ascii_case("respond-async") => {
                preferred = preferred.or(Some(Duration::ZERO));
            }
            Some((name, seconds)) if name.trim().eq_ignore_ascii_case("wait") => {
                let seconds = seconds.trim().trim_matches('"').parse::<u32>().ok();
                preferred = seconds.map(|seconds| Duration::from_secs(seconds.into())).or(preferred);
            }
            _ => {}
        }
    }
    preferred
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use std::time::Duration;

    use axum::http::{HeaderMap, HeaderValue};

    use super::{PREFER, network, preferred};

    #[test]
    fn preferences_as_rfc_7240_has_them() {
        for (header, seconds) in [
            ("respond-async", Some(0)),
            ("Respond-Async", Some(0)),
            ("wait=10", Some(10)),
            ("respond-async, wait=10", Some(10)),
            ("wait=\"5\", respond-async", Some(5)),
            ("return=minimal; x=y", None),
            ("handling=lenient, wait=100; ok=1", Some(100)),
            ("wait=soon", None),
            ("wait=-1", None),
            ("", None),
        ] {
            let headers = HeaderMap::from_iter([(PREFER, HeaderValue::from_static(header))]);
            assert_eq!(preferred(&headers), seconds.map(Duration::from_secs), "{header}");
        }
    }

    #[test]
    fn a_subscriber_is_one_client() {
        let of = |address: &str| address.parse().map(network);
        assert_eq!(of("2001:db8:1:2:3::4"), of("2001:db8:1:2:ffff::1"));
        assert_ne!(of("2001:db8:1:2::1"), of("2001:db8:1:3::1"));
        assert_eq!(of("::ffff:10.0.0.1"), of("10.0.0.1"));
    }
}
