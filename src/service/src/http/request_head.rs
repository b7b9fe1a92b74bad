//! Checks the head of a request more strictly than hyper does.
//!
//! hyper rejects a head by itself with a bare status, without problem document, id and CORS headers. Therefore its
//! limits are above those of the service, and a rejected head becomes a request that passes all layers to the
//! problem.

use axum::http::header::HOST;
use axum::http::uri::Authority;
use axum::http::{HeaderMap, Request, StatusCode, Uri, Version};

use crate::http::error::RequestError;

/// Most bytes of a request's URI.
const URI_BYTES: usize = 16 * 1024;

/// Most bytes of a request's headers.
const HEADER_BYTES: usize = 32 * 1024;

/// Most bytes of request line and headers that hyper reads.
pub(crate) const HYPER_HEAD_BYTES: u16 = 60 * 1024;

/// The path of a request with an invalid head. The service has no route with this path.
const NO_ROUTE: &str = "/unreadable";

/// Extension of a request with an invalid head: the error.
#[derive(Clone, Debug)]
pub(crate) struct InvalidHead(pub RequestError);

/// Redirects a request with an invalid head to the fallback route, which responds with the problem.
pub(crate) fn check<B>(request: &mut Request<B>) {
    if let Err(error) = validate(request) {
        mark_invalid(request, error);
    }
}

/// A request that replaces one that hyper rejected with this status.
pub(crate) fn replacement<B: Default>(status: StatusCode) -> Request<B> {
    let mut request = Request::new(B::default());
    let error = match status {
        StatusCode::URI_TOO_LONG => RequestError::UriTooLong(URI_BYTES),
        StatusCode::REQUEST_HEADER_FIELDS_TOO_LARGE => RequestError::HeadersTooLarge,
        _ => RequestError::MalformedHead(
            "The request is not valid HTTP: its first line or a header is malformed.",
        ),
    };
    mark_invalid(&mut request, error);
    request
}

fn mark_invalid<B>(request: &mut Request<B>, error: RequestError) {
    *request.uri_mut() = Uri::from_static(NO_ROUTE);
    request.extensions_mut().insert(InvalidHead(error));
}

fn validate<B>(request: &Request<B>) -> Result<(), RequestError> {
    let uri = request.uri();
    if uri.path().len() + uri.query().map_or(0, str::len) > URI_BYTES {
        return Err(RequestError::UriTooLong(URI_BYTES));
    }
    if uri.scheme().is_none() && uri.authority().is_some() {
        return Err(RequestError::MalformedHead("The request target is neither a path nor a URL."));
    }
    let headers = request.headers();
    // Each header has a colon, a space and the end of its line.
    let bytes: usize = headers.iter().map(|(name, value)| name.as_str().len() + value.len() + 4).sum();
    if bytes > HEADER_BYTES {
        return Err(RequestError::HeadersTooLarge);
    }
    check_host(request.version(), uri, headers)
}

/// Every request of HTTP/1.1 has one Host; a request of HTTP/2 has `:authority` or Host.
fn check_host(version: Version, uri: &Uri, headers: &HeaderMap) -> Result<(), RequestError> {
    let mut hosts = headers.get_all(HOST).iter();
    let (host, second) = (hosts.next(), hosts.next());
    let Some(host) = host else {
        let is_needed =
            version == Version::HTTP_11 || version > Version::HTTP_11 && uri.authority().is_none();
        return if is_needed {
            Err(RequestError::MalformedHead("The request has no Host header."))
        } else {
            Ok(())
        };
    };
    if second.is_some() {
        return Err(RequestError::MalformedHead("The request has more than one Host header."));
    }
    if host.to_str().is_ok_and(is_host) {
        Ok(())
    } else {
        Err(RequestError::MalformedHead("The Host header is not a host name with an optional port."))
    }
}

fn is_host(text: &str) -> bool {
    let Ok(authority) = text.parse::<Authority>() else { return false };
    // An authority with a user name does not begin with its host.
    let port = text.strip_prefix(authority.host());
    !authority.host().is_empty() && port.is_some_and(|port| port.is_empty() || authority.port_u16().is_some())
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use axum::http::header::HOST;
    use axum::http::{Request, Version};

    use super::validate;
    use crate::http::error::RequestError;

    fn error(version: Version, uri: &str, hosts: &[&[u8]]) -> Option<RequestError> {
        let mut request = Request::get(uri).version(version);
        for host in hosts {
            request = request.header(HOST, *host);
        }
        validate(&request.body(()).unwrap()).err()
    }

    #[test]
    fn a_request_needs_one_valid_host() {
        for host in ["verne", "verne.example.org:8080", "127.0.0.1", "[::1]:8080", "localhost"] {
            assert_eq!(error(Version::HTTP_11, "/fk", &[host.as_bytes()]), None, "{host}");
        }
        let bad: [&[u8]; 8] =
            [b"", b"a b", b"me@verne", b"verne:port", b"[::1", b"\xff", b"verne/fk", b":80"];
        for host in bad {
            let error = error(Version::HTTP_11, "/fk", &[host]);
            assert!(
                matches!(error, Some(RequestError::MalformedHead(_))),
                "{:?}",
                String::from_utf8_lossy(host)
            );
        }
        assert!(error(Version::HTTP_11, "/fk", &[]).is_some());
        assert!(error(Version::HTTP_11, "/fk", &[b"a", b"a"]).is_some());
        assert!(error(Version::HTTP_11, "http://verne/fk", &[]).is_some());
        assert_eq!(error(Version::HTTP_10, "/fk", &[]), None);
        assert_eq!(error(Version::HTTP_2, "http://verne/fk", &[]), None);
        assert!(error(Version::HTTP_2, "/fk", &[]).is_some());
    }

    #[test]
    fn uri_and_headers_have_limits() {
        let uri = |bytes: usize| format!("/fk?{}", "x".repeat(bytes));
        assert_eq!(error(Version::HTTP_11, &uri(16_000), &[b"verne"]), None);
        assert_eq!(
            error(Version::HTTP_11, &uri(17_000), &[b"verne"]),
            Some(RequestError::UriTooLong(16 * 1024))
        );
        let long = Request::get("/fk").header(HOST, "verne").header("x-long", "x".repeat(33_000));
        assert_eq!(validate(&long.body(()).unwrap()), Err(RequestError::HeadersTooLarge));
    }
}
