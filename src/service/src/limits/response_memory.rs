//! The memory of responses until they are sent.

use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll};

use axum::body::{Body, Bytes, HttpBody};
use axum::http::Response;
use axum::http::header::CONTENT_LENGTH;
use hyper::body::{Frame, SizeHint};

use crate::limits::client_quota::QuotaPermit;

/// About the most memory of a response whose content is read while it is sent.
const READ_AHEAD: u64 = 2 * 1024 * 1024;

/// Extension of a response whose bytes, of this number, were made for it and stay in memory until it is sent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct UnsharedBytes(pub u64);

/// About the bytes of memory that a response has for itself; `None` for streams of events, which have a limit of their
/// own.
pub(crate) fn memory_of(response: &Response<Body>) -> Option<u64> {
    let whole = response.body().size_hint().exact();
    let unshared = || response.extensions().get::<UnsharedBytes>().map(|bytes| bytes.0);
    whole.or_else(unshared).or_else(|| {
        let length: u64 = response.headers().get(CONTENT_LENGTH)?.to_str().ok()?.parse().ok()?;
        Some(length.min(READ_AHEAD))
    })
}

/// A body that has a permit until its last byte is sent or dropped.
pub(crate) struct CountedBody {
    body: Body,
    permit: Arc<QuotaPermit>,
}

impl CountedBody {
    pub(crate) fn new(body: Body, permit: QuotaPermit) -> Self {
        Self { body, permit: Arc::new(permit) }
    }
}

impl HttpBody for CountedBody {
    type Data = Bytes;
    type Error = axum::Error;

    fn poll_frame(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, axum::Error>>> {
        let frame = Pin::new(&mut self.body).poll_frame(context);
        let counted = |bytes| bytes_with_permit(bytes, Arc::clone(&self.permit));
        frame.map(|frame| frame.map(|frame| frame.map(|frame| frame.map_data(counted))))
    }

    fn is_end_stream(&self) -> bool {
        self.body.is_end_stream()
    }

    fn size_hint(&self) -> SizeHint {
        self.body.size_hint()
    }
}

/// Bytes that have a permit until they are dropped: hyper keeps bytes after it has dropped their body.
pub(crate) fn bytes_with_permit<B, P>(bytes: B, permit: P) -> Bytes
where
    B: AsRef<[u8]> + Send + 'static,
    P: Send + 'static,
{
    struct Owner<B, P> {
        bytes: B,
        _permit: P,
    }
    impl<B: AsRef<[u8]>, P> AsRef<[u8]> for Owner<B, P> {
        fn as_ref(&self) -> &[u8] {
            self.bytes.as_ref()
        }
    }
    Bytes::from_owner(Owner { bytes, _permit: permit })
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use axum::body::{Body, Bytes};
    use axum::http::Response;
    use axum::http::header::CONTENT_LENGTH;
    use futures_util::stream;
    use http_body_util::BodyExt;

    use super::UnsharedBytes;
    use crate::limits::admission::Admission;
    use crate::limits::error::LimitError;

    /// A thirty-second of the memory of all responses.
    fn large() -> Response<Body> {
        static LARGE: [u8; 64 * 1024 * 1024] = [0; 64 * 1024 * 1024];
        Response::new(Body::from(Bytes::from_static(&LARGE)))
    }

    #[tokio::test]
    async fn responses_that_clients_do_not_read_are_limited() {
        let admission = Admission::new(8, 1);
        let send = |client| admission.count_memory(large(), Some(client));
        let mut unread: Vec<_> = std::iter::from_fn(|| send("a").ok()).collect();
        assert_eq!(unread.len(), 16);
        assert!(send("b").is_ok());
        let mut body = unread.pop().unwrap().into_body();
        let frame = body.frame().await.unwrap().unwrap();
        drop(body);
        assert_eq!(send("a").unwrap_err(), LimitError::Overloaded, "the frame is not sent yet");
        drop(frame);
        assert!(send("a").is_ok());
    }

    #[tokio::test]
    async fn bytes_that_were_made_for_a_response_count_fully() {
        let admission = Admission::new(8, 1);
        let send = || {
            let stream = Body::from_stream(stream::pending::<Result<Bytes, std::io::Error>>());
            let mesh =
                Response::builder().header(CONTENT_LENGTH, 300_000_000).extension(UnsharedBytes(300_000_000));
            admission.count_memory(mesh.body(stream).unwrap(), Some("a"))
        };
        let readers: Vec<_> = std::iter::from_fn(|| send().ok()).collect();
        assert_eq!(readers.len(), 3);
    }

    #[tokio::test]
    async fn hundreds_of_clients_can_read_large_meshes_slowly() {
        let admission = Admission::new(8, 1);
        let stream = || Body::from_stream(stream::pending::<Result<Bytes, std::io::Error>>());
        let mesh = || Response::builder().header(CONTENT_LENGTH, 300_000_000).body(stream()).unwrap();
        let send = || admission.count_memory(mesh(), Some("a"));
        let readers: Vec<_> = std::iter::from_fn(|| send().ok()).collect();
        assert_eq!(readers.len(), 512);
        assert!(admission.count_memory(Response::new(stream()), Some("a")).is_ok());
    }
}
