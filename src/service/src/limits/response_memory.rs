//! Answers on their way, and the memory that they have until they are sent.

use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll};

use axum::body::{Body, Bytes, HttpBody};
use axum::http::Response;
use axum::http::header::CONTENT_LENGTH;
use hyper::body::{Frame, SizeHint};

use crate::limits::client_quota::Share;

/// About the most that an answer has in memory for itself when it is read from elsewhere while it is sent.
const READ_AHEAD: u64 = 2 * 1024 * 1024;

/// Extension of an answer whose bytes, so many, were made for it and are in memory as long as it is sent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Own(pub u64);

/// About the bytes in memory that this answer has for itself; `None` for what has no length, events: they are counted
/// as streams.
pub(crate) fn bytes_of(answer: &Response<Body>) -> Option<u64> {
    let whole = answer.body().size_hint().exact();
    let own = || answer.extensions().get::<Own>().map(|own| own.0);
    whole.or_else(own).or_else(|| {
        let length: u64 = answer.headers().get(CONTENT_LENGTH)?.to_str().ok()?.parse().ok()?;
        Some(length.min(READ_AHEAD))
    })
}

/// A body that has a share until its last byte is sent or given up.
pub(crate) struct Counted {
    body: Body,
    share: Arc<Share>,
}

impl Counted {
    pub(crate) fn new(body: Body, share: Share) -> Self {
        Self { body, share: Arc::new(share) }
    }
}

impl HttpBody for Counted {
    type Data = Bytes;
    type Error = axum::Error;

    fn poll_frame(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, axum::Error>>> {
        let frame = Pin::new(&mut self.body).poll_frame(context);
        let counted = |bytes| with_share(bytes, Arc::clone(&self.share));
        frame.map(|frame| frame.map(|frame| frame.map(|frame| frame.map_data(counted))))
    }

    fn is_end_stream(&self) -> bool {
        self.body.is_end_stream()
    }

    fn size_hint(&self) -> SizeHint {
        self.body.size_hint()
    }
}

/// Bytes that have a share as long as they live: what is handed over to be sent outlives its body.
pub(crate) fn with_share<B, S>(bytes: B, share: S) -> Bytes
where
    B: AsRef<[u8]> + Send + 'static,
    S: Send + 'static,
{
    struct Owner<B, S> {
        bytes: B,
        _share: S,
    }
    impl<B: AsRef<[u8]>, S> AsRef<[u8]> for Owner<B, S> {
        fn as_ref(&self) -> &[u8] {
            self.bytes.as_ref()
        }
    }
    Bytes::from_owner(Owner { bytes, _share: share })
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use axum::body::{Body, Bytes};
    use axum::http::Response;
    use axum::http::header::CONTENT_LENGTH;
    use futures_util::stream;
    use http_body_util::BodyExt;

    use super::Own;
    use crate::limits::admission::Admission;
    use crate::limits::error::LimitError;

    /// A thirty-second of what may be under way, in memory once for all of these tests.
    fn large() -> Response<Body> {
        static LARGE: [u8; 64 * 1024 * 1024] = [0; 64 * 1024 * 1024];
        Response::new(Body::from(Bytes::from_static(&LARGE)))
    }

    #[tokio::test]
    async fn answers_that_are_not_read_have_a_bound() {
        let admission = Admission::new(8, 1);
        let send = |client| admission.send(large(), Some(client));
        let mut unread: Vec<_> = std::iter::from_fn(|| send("a").ok()).collect();
        assert_eq!(unread.len(), 16);
        assert!(send("b").is_ok());
        let mut body = unread.pop().unwrap().into_body();
        let handed_over = body.frame().await.unwrap().unwrap();
        drop(body);
        assert_eq!(send("a").unwrap_err(), LimitError::Overloaded, "what is handed over is not sent yet");
        drop(handed_over);
        assert!(send("a").is_ok());
    }

    #[tokio::test]
    async fn what_was_made_for_an_answer_counts_whole() {
        let admission = Admission::new(8, 1);
        let send = || {
            let stream = Body::from_stream(stream::pending::<Result<Bytes, std::io::Error>>());
            let mesh = Response::builder().header(CONTENT_LENGTH, 300_000_000).extension(Own(300_000_000));
            admission.send(mesh.body(stream).unwrap(), Some("a"))
        };
        let readers: Vec<_> = std::iter::from_fn(|| send().ok()).collect();
        assert_eq!(readers.len(), 3);
    }

    #[tokio::test]
    async fn hundreds_read_large_meshes_slowly_and_events_have_no_part_in_it() {
        let admission = Admission::new(8, 1);
        let stream = || Body::from_stream(stream::pending::<Result<Bytes, std::io::Error>>());
        let mesh = || Response::builder().header(CONTENT_LENGTH, 300_000_000).body(stream()).unwrap();
        let send = || admission.send(mesh(), Some("a"));
        let readers: Vec<_> = std::iter::from_fn(|| send().ok()).collect();
        assert_eq!(readers.len(), 512);
        assert!(admission.send(Response::new(stream()), Some("a")).is_ok());
    }
}
