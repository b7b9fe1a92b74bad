//! Heads of HTTP/1 requests that hyper rejects. hyper sends an empty response; the service sends a problem document,
//! with a request id and the CORS headers, as for any other error.

use std::future::Future;
use std::io;
use std::net::SocketAddr;
use std::time::{Duration, SystemTime};

use axum::Router;
use axum::body::{Body, to_bytes};
use axum::extract::ConnectInfo;
use axum::http::header::{CONNECTION, CONTENT_LENGTH, ORIGIN};
use axum::http::{HeaderValue, Request, StatusCode};
use headers::{Date, HeaderMapExt};
use tokio::io::{AsyncRead, AsyncReadExt, AsyncWrite, AsyncWriteExt};
use tokio::time::timeout;
use tower::ServiceExt;

use crate::http::request_head;
use crate::process::server::exchange::HEAD_BYTES;

/// How long, and how many bytes, the service reads from a client that still sends. If the service closed the connection
/// with unread bytes, the system would reset it and the client might lose the response.
const LINGER_TIME: Duration = Duration::from_secs(1);
const LINGER_BYTES: u64 = 1024 * 1024;

/// Maximum number of bytes of the problem document.
const DOCUMENT_BYTES: usize = 64 * 1024;

/// The status of a response that hyper made by itself: it has no body, and no id, which every response of the service
/// has.
pub(crate) fn bare_status(response: &[u8]) -> Option<StatusCode> {
    let status =
        response.strip_prefix(b"HTTP/1.1 ").or_else(|| response.strip_prefix(b"HTTP/1.0 "))?.get(..3)?;
    let status = StatusCode::from_bytes(status).ok()?;
    let has_id = response.windows(12).any(|bytes| bytes == b"x-request-id");
    (status.is_client_error() && response.ends_with(b"\r\n\r\n") && !has_id).then_some(status)
}

/// A head that hyper has rejected.
pub(crate) struct RejectedHead {
    status: StatusCode,
    /// Its first bytes.
    bytes: Vec<u8>,
}

impl RejectedHead {
    /// hyper has rejected a head that begins with `bytes`.
    pub(crate) fn new(status: StatusCode, bytes: Vec<u8>) -> Self {
        Self { status, bytes }
    }

    /// Sends the problem document and closes the connection.
    pub(crate) async fn answer<I>(mut self, mut io: I, router: Router, peer: SocketAddr) -> io::Result<()>
    where
        I: AsyncRead + AsyncWrite + Unpin,
    {
        // hyper rejects some heads before it has read all of them.
        drop(timeout(LINGER_TIME, self.read_rest(&mut io)).await);
        io.write_all(&self.response(router, peer).await).await?;
        io.shutdown().await?;
        let mut rest = (&mut io).take(LINGER_BYTES);
        drop(timeout(LINGER_TIME, tokio::io::copy(&mut rest, &mut tokio::io::sink())).await);
        Ok(())
    }

    async fn read_rest(&mut self, io: &mut (impl AsyncRead + Unpin)) -> io::Result<()> {
        while self.bytes.len() < HEAD_BYTES && !self.bytes.windows(4).any(|end| end == b"\r\n\r\n") {
            if io.read_buf(&mut self.bytes).await? == 0 {
                break;
            }
        }
        Ok(())
    }

    /// The head and the body of the router's response to this request.
    fn response(&self, router: Router, peer: SocketAddr) -> impl Future<Output = Vec<u8>> + use<> {
        let mut request: Request<Body> = request_head::replacement(self.reason());
        request.headers_mut().extend(self.origin().map(|origin| (ORIGIN, origin)));
        request.extensions_mut().insert(ConnectInfo(peer));
        async move {
            let Ok(response) = router.oneshot(request).await;
            let (mut parts, body) = response.into_parts();
            let body = to_bytes(body, DOCUMENT_BYTES).await.unwrap_or_default();
            parts.headers.insert(CONNECTION, HeaderValue::from_static("close"));
            parts.headers.insert(CONTENT_LENGTH, body.len().into());
            parts.headers.typed_insert(Date::from(SystemTime::now()));
            let mut bytes = format!("HTTP/1.1 {}\r\n", parts.status).into_bytes();
            for (name, value) in &parts.headers {
                bytes.extend([name.as_str().as_bytes(), b": ", value.as_bytes(), b"\r\n"].concat());
            }
            bytes.extend_from_slice(b"\r\n");
            bytes.extend_from_slice(&body);
            bytes
        }
    }

    /// hyper's reason, corrected: hyper reports an address that is too long as a head that is too large.
    fn reason(&self) -> StatusCode {
        match self.status {
            StatusCode::REQUEST_HEADER_FIELDS_TOO_LARGE if !self.bytes.contains(&b'\n') => {
                StatusCode::URI_TOO_LONG
            }
            status => status,
        }
    }

    /// The origin of the page that sent the request, if the header is among the first bytes.
    fn origin(&self) -> Option<HeaderValue> {
        let lines = self.bytes.split(|&byte| byte == b'\n').skip(1);
        let values = lines.filter_map(|line| {
            let (name, value) = line.split_at_checked(ORIGIN.as_str().len() + 1)?;
            let is_origin = name.strip_suffix(b":")?.eq_ignore_ascii_case(ORIGIN.as_str().as_bytes());
            is_origin.then(|| HeaderValue::from_bytes(value.trim_ascii()).ok()).flatten()
        });
        values.last()
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use axum::http::StatusCode;

    use super::{RejectedHead, bare_status};

    const TOO_LARGE: StatusCode = StatusCode::REQUEST_HEADER_FIELDS_TOO_LARGE;

    #[test]
    fn the_origin_is_read_from_a_head_with_other_errors() {
        let text = b"GET /fk\xff HTTP/1.1\r\nHost: verne\r\nORIGIN: https://example.org\r\nx: y";
        let head = RejectedHead::new(StatusCode::BAD_REQUEST, text.to_vec());
        assert_eq!(head.origin().unwrap(), "https://example.org");
        let head = RejectedHead::new(StatusCode::BAD_REQUEST, text[..30].to_vec());
        assert_eq!(head.origin(), None);
    }

    #[test]
    fn a_head_without_the_end_of_its_first_line_has_a_long_address() {
        let reason = |status, bytes: &[u8]| RejectedHead::new(status, bytes.to_vec()).reason();
        assert_eq!(reason(TOO_LARGE, b"GET /fk HTTP/1.1\r\nx: y"), TOO_LARGE);
        assert_eq!(reason(TOO_LARGE, &[b'x'; 8_000]), StatusCode::URI_TOO_LONG);
        assert_eq!(reason(StatusCode::BAD_REQUEST, &[b'x'; 8_000]), StatusCode::BAD_REQUEST);
    }

    #[test]
    fn only_responses_that_hyper_made_are_bare() {
        for (response, status) in [
            ("HTTP/1.1 400 Bad Request\r\ncontent-length: 0\r\n\r\n", Some(StatusCode::BAD_REQUEST)),
            (
                "HTTP/1.1 414 URI Too Long\r\ncontent-length: 0\r\ndate: x\r\n\r\n",
                Some(StatusCode::URI_TOO_LONG),
            ),
            ("HTTP/1.1 404 Not Found\r\nx-request-id: 1\r\ncontent-length: 0\r\n\r\n", None),
            ("HTTP/1.1 200 OK\r\ncontent-length: 0\r\n\r\n", None),
            ("HTTP/1.1 100 Continue\r\n\r\n", None),
            ("{}", None),
        ] {
            assert_eq!(bare_status(response.as_bytes()), status, "{response}");
        }
    }
}
