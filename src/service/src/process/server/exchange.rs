//! The state of the current request on an HTTP/1 connection. The service reports it to the connection's stream.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use axum::body::{Body, Bytes, HttpBody};
use axum::http::{Request, Version};
use http_body_util::BodyExt;
use hyper::body::Incoming;

/// Maximum number of bytes of a request's head that are remembered.
pub(crate) const HEAD_BYTES: usize = 8 * 1024;

/// Progress between a request and the last byte of its response.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Stage {
    /// There is no request, or its head is incomplete.
    #[default]
    Idle,
    /// The service reads the body.
    Receiving(Version),
    /// The request is complete, and the response has not begun.
    Processing(Version),
    /// The response has begun.
    Responding,
}

/// The current request of a connection. HTTP/1 begins a request after the response to the previous one.
#[derive(Clone, Debug, Default)]
pub(crate) struct Exchange(Arc<Mutex<State>>);

#[derive(Debug, Default)]
struct State {
    stage: Stage,
    /// The first bytes of an incomplete head.
    head: Vec<u8>,
}

impl Exchange {
    /// The stage of the current request.
    pub(crate) fn stage(&self) -> Stage {
        self.state().stage
    }

    /// The client has sent more bytes.
    pub(crate) fn read(&self, bytes: &[u8]) {
        let mut state = self.state();
        if state.stage == Stage::Idle {
            let room = HEAD_BYTES.saturating_sub(state.head.len());
            state.head.extend_from_slice(bytes.get(..room).unwrap_or(bytes));
        }
    }

    /// The first bytes of the head that hyper has rejected.
    pub(crate) fn take_head(&self) -> Vec<u8> {
        std::mem::take(&mut self.state().head)
    }

    /// hyper has read the head of a request. The request is complete when its body is dropped.
    pub(crate) fn begin(&self, request: Request<Incoming>) -> Request<Body> {
        let version = request.version();
        *self.state() = State { stage: Stage::Receiving(version), head: Vec::new() };
        let next = StageAfterBody { exchange: self.clone(), stage: Stage::Processing(version) };
        if request.body().is_end_stream() {
            return request.map(Body::new);
        }
        request.map(|body| Body::new(with_guard(body, next)))
    }

    /// The response begins. It ends when hyper drops the body.
    pub(crate) fn respond(&self, body: Body) -> impl HttpBody<Data = Bytes, Error = axum::Error> + use<> {
        self.state().stage = Stage::Responding;
        with_guard(body, StageAfterBody { exchange: self.clone(), stage: Stage::Idle })
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Sets a stage when it is dropped.
struct StageAfterBody {
    exchange: Exchange,
    stage: Stage,
}

impl Drop for StageAfterBody {
    fn drop(&mut self) {
        let mut state = self.exchange.state();
        // A request's body may outlive the beginning of the response.
        if self.stage == Stage::Idle || matches!(state.stage, Stage::Receiving(_)) {
            state.stage = self.stage;
        }
    }
}

/// The same body; it drops `guard` when it is dropped itself.
fn with_guard<B: HttpBody>(
    body: B,
    guard: StageAfterBody,
) -> impl HttpBody<Data = B::Data, Error = B::Error> {
    body.map_err(move |error| {
        let _ = &guard;
        error
    })
}
