//! What hyper refuses by itself, with a document in place of its bare answer.

use std::io;
use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll, ready};
use std::time::Duration;

use axum::http::header::ORIGIN;
use axum::http::{HeaderValue, StatusCode};
use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio::time::{Sleep, sleep};

use crate::process::server::exchange::{Exchange, Stage};

/// How long, and how much, is read of a peer that is refused while it still sends: a connection that is closed with
/// bytes unread is reset, and the answer may be lost.
const LINGER: Duration = Duration::from_secs(1);
const LINGER_BYTES: usize = 1024 * 1024;

/// The whole answer, head and body, to a request of such an origin that hyper has refused with a status.
pub(crate) type Answering = Arc<dyn Fn(StatusCode, Option<HeaderValue>) -> Making + Send + Sync>;

/// The answer's bytes, which are made.
pub(crate) type Making = Pin<Box<dyn Future<Output = Vec<u8>> + Send>>;

/// Most bytes that are looked at of what is refused.
const HEAD_BYTES: usize = 8 * 1024;

/// How the head begins that is read.
#[derive(Debug, Default)]
pub(crate) struct Head {
    bytes: Vec<u8>,
    /// How many requests had begun before it.
    before: u64,
}

impl Head {
    /// More of it has come, or the first of the next.
    pub(crate) fn read(&mut self, bytes: &[u8], exchange: &Exchange) {
        if exchange.stage() != Stage::Idle || exchange.begun() != self.before {
            *self = Self { bytes: Vec::new(), before: exchange.begun() };
        }
        if exchange.stage() == Stage::Idle {
            let room = HEAD_BYTES - self.bytes.len();
            self.bytes.extend_from_slice(bytes.get(..room).unwrap_or(bytes));
        }
    }

    /// What is really wrong: to hyper an address that is too long is a head that is.
    fn reason(&self, status: StatusCode) -> StatusCode {
        match status {
            StatusCode::REQUEST_HEADER_FIELDS_TOO_LARGE if !self.bytes.contains(&b'\n') => {
                StatusCode::URI_TOO_LONG
            }
            status => status,
        }
    }

    /// The page's origin, if it stands at the beginning.
    fn origin(&self) -> Option<HeaderValue> {
        let lines = self.bytes.split(|&byte| byte == b'\n').skip(1);
        let values = lines.filter_map(|line| {
            let (name, value) = line.split_at_checked(ORIGIN.as_str().len() + 1)?;
            let is_origin = name.strip_suffix(b":")?.eq_ignore_ascii_case(ORIGIN.as_str().as_bytes());
            is_origin.then(|| HeaderValue::from_bytes(value.trim_ascii()).ok()).flatten()
        });
        values.last()
    }

    /// Reads what else comes of it, as far as it is looked at. hyper refuses some heads at their first bytes.
    fn poll_rest<I: AsyncRead + Unpin>(&mut self, context: &mut Context<'_>, io: &mut I) -> Poll<()> {
        let mut bytes = [0; 1024];
        while self.bytes.len() < HEAD_BYTES && !self.bytes.windows(4).any(|end| end == b"\r\n\r\n") {
            let mut buffer = ReadBuf::new(&mut bytes);
            let read = ready!(Pin::new(&mut *io).poll_read(context, &mut buffer));
            if read.is_err() || buffer.filled().is_empty() {
                break;
            }
            self.bytes.extend_from_slice(buffer.filled());
        }
        Poll::Ready(())
    }
}

/// A refusal on its way.
pub(crate) enum Refusal {
    /// The rest of the head is read, for a bounded time.
    Read(StatusCode, Pin<Box<Sleep>>),
    /// It is made.
    Made(Making),
    /// It is sent, from this byte on.
    Sent(Vec<u8>, usize),
    /// It is sent; the rest of what the peer sends is read over.
    Lingering(Pin<Box<Sleep>>, usize),
    /// Nothing is left to do.
    Over,
}

impl Refusal {
    /// Of what hyper refuses with these bytes, where it does.
    pub(crate) fn of(bytes: &[u8], exchange: &Exchange) -> Option<Self> {
        let status = bare_status(bytes).filter(|_| exchange.stage() == Stage::Idle)?;
        Some(Self::Read(status, Box::pin(sleep(LINGER))))
    }

    /// Hands all of it over.
    pub(crate) fn poll_send<I: AsyncRead + AsyncWrite + Unpin>(
        &mut self,
        context: &mut Context<'_>,
        io: &mut I,
        head: &mut Head,
        answering: &Answering,
    ) -> Poll<io::Result<()>> {
        loop {
            match self {
                Self::Read(status, pause) => {
                    if head.poll_rest(context, io).is_pending() {
                        ready!(pause.as_mut().poll(context));
                    }
                    *self = Self::Made(answering(head.reason(*status), head.origin()));
                }
                Self::Made(making) => *self = Self::Sent(ready!(making.as_mut().poll(context)), 0),
                Self::Sent(bytes, sent) => {
                    let rest = bytes.get(*sent..).unwrap_or_default();
                    if rest.is_empty() {
                        *self = Self::Lingering(Box::pin(sleep(LINGER)), 0);
                    } else {
                        match ready!(Pin::new(&mut *io).poll_write(context, rest))? {
                            0 => return Poll::Ready(Err(io::ErrorKind::WriteZero.into())),
                            count => *sent += count,
                        }
                    }
                }
                Self::Lingering(..) | Self::Over => return Poll::Ready(Ok(())),
            }
        }
    }

    /// Reads what the peer still sends, until it has closed its direction, or for a bounded time and length.
    pub(crate) fn poll_linger<I: AsyncRead + Unpin>(
        &mut self,
        context: &mut Context<'_>,
        io: &mut I,
    ) -> Poll<()> {
        let Self::Lingering(pause, read) = self else { return Poll::Ready(()) };
        let mut bytes = [0; 4096];
        loop {
            let mut buffer = ReadBuf::new(&mut bytes);
            let has_more = match Pin::new(&mut *io).poll_read(context, &mut buffer) {
                Poll::Ready(Ok(())) => !buffer.filled().is_empty(),
                Poll::Pending if pause.as_mut().poll(context).is_pending() => return Poll::Pending,
                Poll::Ready(Err(_)) | Poll::Pending => false,
            };
            *read += buffer.filled().len();
            if !has_more || *read > LINGER_BYTES {
                *self = Self::Over;
                return Poll::Ready(());
            }
        }
    }
}

/// The status of an answer that hyper gives by itself: it has no body and no id, which each of ours has.
fn bare_status(head: &[u8]) -> Option<StatusCode> {
    let status = head.strip_prefix(b"HTTP/1.1 ").or_else(|| head.strip_prefix(b"HTTP/1.0 "))?.get(..3)?;
    let status = StatusCode::from_bytes(status).ok()?;
    let holds = |text: &[u8]| head.windows(text.len()).any(|bytes| bytes == text);
    let is_bare = status.is_client_error() && head.ends_with(b"\r\n\r\n") && !holds(b"x-request-id");
    is_bare.then_some(status)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use axum::http::StatusCode;

    use super::{Head, bare_status};
    use crate::process::server::exchange::Exchange;

    #[test]
    fn of_a_head_the_origin_counts_and_whether_its_first_line_ends() {
        let mut head = Head::default();
        head.read(b"GET /fk\xff HTTP/1.1\r\nHost: verne\r\nORI", &Exchange::default());
        assert_eq!(head.origin(), None);
        head.read(b"GIN: https://example.org\r\nx: y", &Exchange::default());
        assert_eq!(head.origin().unwrap(), "https://example.org");
        let large = StatusCode::REQUEST_HEADER_FIELDS_TOO_LARGE;
        assert_eq!(head.reason(large), large);
        let mut line = Head::default();
        line.read(&[b'x'; 10_000], &Exchange::default());
        assert_eq!(line.reason(large), StatusCode::URI_TOO_LONG);
        assert_eq!(line.reason(StatusCode::BAD_REQUEST), StatusCode::BAD_REQUEST);
    }

    #[test]
    fn only_what_hyper_says_by_itself_is_bare() {
        for (head, status) in [
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
            assert_eq!(bare_status(head.as_bytes()), status, "{head}");
        }
    }
}
