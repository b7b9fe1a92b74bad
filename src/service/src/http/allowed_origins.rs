//! What a browser's pages may ask: the names of the service, and the origins whose pages may start work.
//!
//! A page of another origin cannot read answers unless CORS lets it, but it can send requests: an image, a form. And a
//! page whose host name is rebound to this address is, to the browser, a page of ours: only Host shows the difference.

use std::net::IpAddr;

use axum::http::header::{HOST, ORIGIN};
use axum::http::uri::Authority;
use axum::http::{HeaderMap, HeaderName, Uri};

use crate::http::error::AccessError;
use crate::http::origin::Origin;
use crate::http::proxy::HostName;

/// How a browser says where a request comes from (W3C Fetch Metadata). Pages cannot set it.
const FETCH_SITE: HeaderName = HeaderName::from_static("sec-fetch-site");

const LOCALHOST: &str = "localhost";

/// Names and origins that the settings allow.
#[derive(Debug, Default)]
pub(crate) struct Pages {
    /// Names beside localhost; nothing for any.
    names: Option<Vec<HostName>>,
    origins: Vec<Origin>,
}

impl Pages {
    /// As the settings have it. Where others can reach the service its names are not known unless they are given.
    pub(crate) fn new(names: &[HostName], origins: &[Origin], loopback: bool) -> Self {
        let any = names.iter().any(HostName::is_any) || names.is_empty() && !loopback;
        Self { names: (!any).then(|| names.to_vec()), origins: origins.to_vec() }
    }

    /// Fails for a name that is not the service's. An address is no name that could be rebound; a request without a
    /// name comes from no browser.
    pub(crate) fn check_host(&self, uri: &Uri, headers: &HeaderMap) -> Result<(), AccessError> {
        let (Some(names), Some(authority)) = (&self.names, authority(uri, headers)) else { return Ok(()) };
        let host = host(&authority);
        let is_known =
            is_address(&host) || is_localhost(&host) || names.iter().any(|name| name.as_str() == host);
        if is_known { Ok(()) } else { Err(AccessError::HostNotAllowed(host)) }
    }

    /// Whether a page sends the request that is neither the service's own nor of an origin that may ask.
    pub(crate) fn are_foreign(&self, uri: &Uri, headers: &HeaderMap) -> bool {
        let origin = headers.get(ORIGIN);
        let is_named = |origin| self.origins.iter().any(|named| named.is_any() || Some(&named.0) == origin);
        match headers.get(FETCH_SITE).map(axum::http::HeaderValue::as_bytes) {
            // The page itself, or what a user has typed or chosen among bookmarks.
            Some(b"same-origin" | b"none") => false,
            Some(_) => !is_named(origin),
            // No browser; or one that does not say it: an old one, or over HTTP without TLS.
            None => match origin {
                None => false,
                origin => !is_named(origin) && !self.is_own(origin, uri, headers),
            },
        }
    }

    /// Whether the origin is the address of the request, or has one of the names that were given.
    fn is_own(&self, origin: Option<&axum::http::HeaderValue>, uri: &Uri, headers: &HeaderMap) -> bool {
        let origin = origin.and_then(|origin| origin.to_str().ok()?.parse::<Uri>().ok());
        let Some((scheme, of_page)) =
            origin.as_ref().and_then(|uri| Some((uri.scheme_str()?, uri.authority()?)))
        else {
            return false;
        };
        let usual = if scheme == "https" { 443 } else { 80 };
        let place = |authority: &Authority| (host(authority), authority.port_u16().unwrap_or(usual));
        let is_given = self.names.iter().flatten().any(|name| name.as_str() == host(of_page));
        is_given || authority(uri, headers).is_some_and(|of_request| place(&of_request) == place(of_page))
    }
}

/// What the client calls the service. In HTTP/2, and where a request names all of its address, Host does not count.
fn authority(uri: &Uri, headers: &HeaderMap) -> Option<Authority> {
    let of_header = || headers.get(HOST)?.to_str().ok()?.parse().ok();
    uri.authority().cloned().or_else(of_header)
}

/// The host in small letters, without the dot that may end a name.
fn host(authority: &Authority) -> String {
    let host = authority.host();
    host.strip_suffix('.').unwrap_or(host).to_ascii_lowercase()
}

fn is_address(host: &str) -> bool {
    host.trim_start_matches('[').trim_end_matches(']').parse::<IpAddr>().is_ok()
}

fn is_localhost(host: &str) -> bool {
    host.strip_suffix(LOCALHOST).is_some_and(|rest| rest.is_empty() || rest.ends_with('.'))
}
