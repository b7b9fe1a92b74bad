//! How far the exchange on a connection of HTTP/1 is, as the service tells its stream.
//!
//! A client may close its direction of the connection when its request is sent, and wait for the answer. To the system
//! a client that has gone looks the same, until something is sent to it.

use std::pin::Pin;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::task::{Context, Poll, ready};

use axum::body::Bytes;
use axum::http::{Request, Version};
use hyper::body::{Body, Frame, Incoming, SizeHint};

/// Between a request and the last byte of its answer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Stage {
    /// There is no request.
    #[default]
    Idle,
    /// The body is still read.
    Receiving(Version),
    /// The request is whole, the answer has not begun.
    Awaited(Version),
    /// The answer has begun.
    Answered,
}

/// One at a time: over HTTP/1 a request is not begun before the last one is answered.
#[derive(Clone, Debug, Default)]
pub(crate) struct Exchange(Arc<Mutex<(Stage, u64)>>);

impl Exchange {
    /// How far it is.
    pub(crate) fn stage(&self) -> Stage {
        self.locked().0
    }

    /// How many requests have begun.
    pub(crate) fn begun(&self) -> u64 {
        self.locked().1
    }

    /// A request has come; over HTTP/2 its answer is independent of the stream's direction.
    pub(crate) fn begin(&self, request: Request<Incoming>) -> Request<Arriving> {
        let version = request.version();
        if version < Version::HTTP_2 {
            let is_whole = request.body().is_end_stream();
            self.set(if is_whole { Stage::Awaited(version) } else { Stage::Receiving(version) });
            self.locked().1 += 1;
        }
        request.map(|body| Arriving { body, exchange: self.clone() })
    }

    /// The answer begins.
    pub(crate) fn answer(&self) {
        if self.stage() != Stage::Idle {
            self.set(Stage::Answered);
        }
    }

    /// The answer is handed over, or nobody wants it.
    pub(crate) fn end(&self) {
        self.set(Stage::Idle);
    }

    fn arrived(&self) {
        if let Stage::Receiving(version) = self.stage() {
            self.set(Stage::Awaited(version));
        }
    }

    fn set(&self, stage: Stage) {
        self.locked().0 = stage;
    }

    fn locked(&self) -> MutexGuard<'_, (Stage, u64)> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A body that tells when it is whole.
#[derive(Debug)]
pub(crate) struct Arriving {
    body: Incoming,
    exchange: Exchange,
}

impl Body for Arriving {
    type Data = Bytes;
    type Error = hyper::Error;

    fn poll_frame(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, hyper::Error>>> {
        let frame = ready!(Pin::new(&mut self.body).poll_frame(context));
        if frame.is_none() || self.body.is_end_stream() {
            self.exchange.arrived();
        }
        Poll::Ready(frame)
    }

    fn is_end_stream(&self) -> bool {
        self.body.is_end_stream()
    }

    fn size_hint(&self) -> SizeHint {
        self.body.size_hint()
    }
}
