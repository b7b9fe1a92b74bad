//! The host names of the service, and the origins whose web pages may start jobs.
//!
//! A page of another origin cannot read responses unless CORS allows it, but it can send requests, for example by an
//! image or a form. A page whose host name was rebound to this service's address has the service's origin for the
//! browser; only the header Host reveals it.

use std::net::IpAddr;

use axum::http::header::{HOST, ORIGIN};
use axum::http::uri::Authority;
use axum::http::{HeaderMap, HeaderName, HeaderValue, Uri};

use crate::http::error::AccessError;
use crate::http::origin::Origin;
use crate::http::proxy::HostName;

/// The relation between the page that sends a request and the service (W3C Fetch Metadata). Pages cannot set it.
const FETCH_SITE: HeaderName = HeaderName::from_static("sec-fetch-site");

const LOCALHOST: &str = "localhost";

/// The host names and origins that the settings allow.
#[derive(Debug, Default)]
pub(crate) struct AllowedOrigins {
    /// Host names in addition to localhost; `None` allows every name.
    hosts: Option<Vec<HostName>>,
    origins: Vec<Origin>,
}

impl AllowedOrigins {
    /// The names and origins of the settings. Without names, a service that only this machine can reach allows
    /// localhost, and any other service every name.
    pub(crate) fn new(hosts: &[HostName], origins: &[Origin], is_loopback: bool) -> Self {
        let any = hosts.iter().any(HostName::is_any) || hosts.is_empty() && !is_loopback;
        Self { hosts: (!any).then(|| hosts.to_vec()), origins: origins.to_vec() }
    }

    /// Fails if the service does not have the host name of the request. An address cannot be rebound; a request without
    /// a name comes from no browser.
    pub(crate) fn check_host(&self, uri: &Uri, headers: &HeaderMap) -> Result<(), AccessError> {
        let (Some(hosts), Some(authority)) = (&self.hosts, authority(uri, headers)) else { return Ok(()) };
        let host = host(&authority);
        let is_allowed =
            is_address(&host) || is_localhost(&host) || hosts.iter().any(|name| name.as_str() == host);
        if is_allowed { Ok(()) } else { Err(AccessError::HostNotAllowed(host)) }
    }

    /// Whether a page sends the request whose origin is neither the service's own nor an allowed one.
    pub(crate) fn is_cross_origin(&self, uri: &Uri, headers: &HeaderMap) -> bool {
        let origin = headers.get(ORIGIN);
        let is_allowed = |origin| self.origins.iter().any(|named| named.is_any() || Some(&named.0) == origin);
        match headers.get(FETCH_SITE).map(HeaderValue::as_bytes) {
            // The service's own page, or an address that the user typed or bookmarked.
            Some(b"same-origin" | b"none") => false,
            Some(_) => !is_allowed(origin),
            // Not a browser, an old one, or HTTP without TLS.
            None => origin.is_some_and(|own| !is_allowed(origin) && !self.is_own(own, uri, headers)),
        }
    }

    /// Whether the origin has the address of the request, or an allowed host name.
    fn is_own(&self, origin: &HeaderValue, uri: &Uri, headers: &HeaderMap) -> bool {
        let origin = origin.to_str().ok().and_then(|origin| origin.parse::<Uri>().ok());
        let Some((scheme, of_page)) =
            origin.as_ref().and_then(|uri| Some((uri.scheme_str()?, uri.authority()?)))
        else {
            return false;
        };
        let default_port = if scheme == "https" { 443 } else { 80 };
        let address = |authority: &Authority| (host(authority), authority.port_u16().unwrap_or(default_port));
        let is_allowed = self.hosts.iter().flatten().any(|name| name.as_str() == host(of_page));
        is_allowed
            || authority(uri, headers).is_some_and(|of_request| address(&of_request) == address(of_page))
    }
}

/// The authority to which the client sends the request. An authority in the URI, as HTTP/2 has it, overrides Host.
fn authority(uri: &Uri, headers: &HeaderMap) -> Option<Authority> {
    let of_header = || headers.get(HOST)?.to_str().ok()?.parse().ok();
    uri.authority().cloned().or_else(of_header)
}

/// The host in lowercase, without a dot at its end.
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
