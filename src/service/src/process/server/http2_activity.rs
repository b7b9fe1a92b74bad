//! Requests and responses of an HTTP/2 connection: whether there is any, and whether the client reads.
//!
//! A client can open the flow-control window of no stream and still answer pings. Then neither the socket nor hyper
//! shows that the client reads nothing. So the responses themselves record when the client takes bytes.

use std::pin::Pin;
use std::sync::{Arc, Mutex, PoisonError};
use std::task::{Context, Poll};
use std::time::{Duration, Instant};

use axum::body::{Body, Bytes};
use hyper::body::{Body as HttpBody, Buf, Frame, SizeHint};
use tokio::sync::watch;

/// The activity of one connection.
#[derive(Debug, Default)]
pub(crate) struct Http2Activity {
    requests: watch::Sender<usize>,
    output: Mutex<Output>,
}

/// What the connection sends.
#[derive(Debug, Default)]
struct Output {
    /// Number of bodies and chunks that wait for the client.
    waiting: usize,
    /// When the client last took bytes, or a response began.
    moved: Option<Instant>,
}

impl Http2Activity {
    /// A request has arrived.
    pub(crate) fn begin(self: &Arc<Self>) -> RequestInProgress {
        self.requests.send_modify(|requests| *requests += 1);
        RequestInProgress { activity: Arc::clone(self) }
    }

    /// Returns when no request has been in progress for `limit`.
    pub(crate) async fn idle(&self, limit: Duration) {
        let mut requests = self.requests.subscribe();
        // The sender lives as long as `self`.
        while requests.wait_for(|requests| *requests == 0).await.is_ok() {
            if tokio::time::timeout(limit, requests.changed()).await.is_err() {
                return;
            }
        }
    }

    /// Returns when responses have waited for the client, which took nothing, for 1 to 1.5 times `limit`.
    pub(crate) async fn stalled(&self, limit: Duration) {
        loop {
            tokio::time::sleep(limit / 2).await;
            let output = self.output.lock().unwrap_or_else(PoisonError::into_inner);
            if output.waiting > 0 && output.moved.is_some_and(|moved| moved.elapsed() >= limit) {
                return;
            }
        }
    }

    fn moved(&self, change_waiting: impl FnOnce(&mut usize)) {
        let mut output = self.output.lock().unwrap_or_else(PoisonError::into_inner);
        change_waiting(&mut output.waiting);
        output.moved = Some(Instant::now());
    }
}

/// A request until the client has taken the last byte of its response.
#[derive(Debug)]
pub(crate) struct RequestInProgress {
    activity: Arc<Http2Activity>,
}

impl RequestInProgress {
    /// Watches the body of the response.
    pub(crate) fn watch(self, body: Body) -> WatchedBody {
        self.activity.moved(|waiting| *waiting += 1);
        WatchedBody { body, waits_for_client: true, request: Arc::new(self) }
    }
}

impl Drop for RequestInProgress {
    fn drop(&mut self) {
        self.activity.requests.send_modify(|requests| *requests -= 1);
    }
}

/// A body that waits for the client, except while its next frame is being made. hyper asks for a frame only if the
/// client is ready for it.
#[derive(Debug)]
pub(crate) struct WatchedBody {
    body: Body,
    waits_for_client: bool,
    request: Arc<RequestInProgress>,
}

impl WatchedBody {
    fn set_waiting(&mut self, waits: bool) {
        let before = std::mem::replace(&mut self.waits_for_client, waits);
        self.request.activity.moved(|waiting| *waiting = *waiting + usize::from(waits) - usize::from(before));
    }
}

impl HttpBody for WatchedBody {
    type Data = WatchedBytes;
    type Error = axum::Error;

    fn poll_frame(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<WatchedBytes>, axum::Error>>> {
        let poll = Pin::new(&mut self.body).poll_frame(context);
        self.set_waiting(poll.is_ready());
        let watched = |bytes| WatchedBytes::new(bytes, Arc::clone(&self.request));
        poll.map(|frame| frame.map(|frame| frame.map(|frame| frame.map_data(watched))))
    }

    fn is_end_stream(&self) -> bool {
        self.body.is_end_stream()
    }

    fn size_hint(&self) -> SizeHint {
        self.body.size_hint()
    }
}

impl Drop for WatchedBody {
    fn drop(&mut self) {
        self.set_waiting(false);
    }
}

/// Bytes that wait for the client until they are dropped.
#[derive(Debug)]
pub(crate) struct WatchedBytes {
    bytes: Bytes,
    request: Arc<RequestInProgress>,
}

impl WatchedBytes {
    fn new(bytes: Bytes, request: Arc<RequestInProgress>) -> Self {
        request.activity.moved(|waiting| *waiting += 1);
        Self { bytes, request }
    }
}

impl Buf for WatchedBytes {
    fn remaining(&self) -> usize {
        self.bytes.remaining()
    }

    fn chunk(&self) -> &[u8] {
        self.bytes.chunk()
    }

    fn advance(&mut self, count: usize) {
        self.bytes.advance(count);
        self.request.activity.moved(|_| {});
    }
}

impl Drop for WatchedBytes {
    fn drop(&mut self) {
        self.request.activity.moved(|waiting| *waiting -= 1);
    }
}
