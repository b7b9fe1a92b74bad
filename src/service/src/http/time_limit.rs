//! The time limit of requests. The answer tells a client whose body arrives slowly from work that takes long.

use std::pin::{Pin, pin};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::task::{Context, Poll};
use std::time::Duration;

use axum::body::{Body, Bytes, HttpBody};
use axum::extract::{Request, State};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use hyper::body::{Frame, SizeHint};
use tokio::time::timeout;

use crate::http::error::{HttpError, RequestError};

/// Ends a request that takes longer than the limit.
pub(crate) async fn limit_time(State(limit): State<Duration>, request: Request, next: Next) -> Response {
    let waits_for_body = Arc::new(AtomicBool::new(false));
    let request = if request.body().is_end_stream() {
        request
    } else {
        request.map(|body| Body::new(ArrivingBody { body, waits: Arc::clone(&waits_for_body) }))
    };
    let mut answer = pin!(next.run(request));
    match timeout(limit, answer.as_mut()).await {
        Ok(response) => response,
        Err(_) if waits_for_body.load(Ordering::Relaxed) => {
            HttpError::from(RequestError::SlowBody(limit.as_secs())).into_response()
        }
        Err(_) => HttpError::TimedOut.into_response(),
    }
}

/// A body that states whether the service waits for its next bytes.
struct ArrivingBody {
    body: Body,
    waits: Arc<AtomicBool>,
}

impl HttpBody for ArrivingBody {
    type Data = Bytes;
    type Error = axum::Error;

    fn poll_frame(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, axum::Error>>> {
        let poll = Pin::new(&mut self.body).poll_frame(context);
        self.waits.store(poll.is_pending(), Ordering::Relaxed);
        poll
    }

    fn is_end_stream(&self) -> bool {
        self.body.is_end_stream()
    }

    fn size_hint(&self) -> SizeHint {
        self.body.size_hint()
    }
}

impl Drop for ArrivingBody {
    fn drop(&mut self) {
        self.waits.store(false, Ordering::Relaxed);
    }
}
