//! A client that has closed its direction of an HTTP/1 connection. It may wait for the response, or it may have gone.
//!
//! The system reports both in the same way until the service sends something: a client that has gone resets the
//! connection, and the next write fails. So the service sends `100 Continue` at intervals while it processes the
//! request; a client of HTTP/1.1 ignores it. A client of HTTP/1.0 would take it for the response, so its time is
//! limited instead.

use std::io;
use std::pin::Pin;
use std::task::{Context, Poll, ready};
use std::time::Duration;

use axum::http::Version;
use tokio::io::AsyncWrite;
use tokio::time::{Sleep, sleep};

use crate::process::server::exchange::{Exchange, Stage};

const INTERIM_RESPONSE: &[u8] = b"HTTP/1.1 100 Continue\r\n\r\n";

/// After so many pauses, 9 s together, the service assumes that a client of HTTP/1.0 has gone. This is less than the
/// usual time for which a request waits for its job, so the service cancels the job of a client that has gone.
const HTTP10_PAUSES: u32 = 4;

/// The pauses since the client has closed its direction.
#[derive(Debug, Default)]
pub(crate) struct HalfClosed {
    pauses: u32,
    pause: Option<Pin<Box<Sleep>>>,
}

impl HalfClosed {
    /// Ready when hyper may read the end of the client's direction, or when a write has failed.
    pub(crate) fn poll_end<I: AsyncWrite + Unpin>(
        &mut self,
        context: &mut Context<'_>,
        io: &mut I,
        exchange: &Exchange,
    ) -> Poll<io::Result<()>> {
        loop {
            let stage = exchange.stage();
            match stage {
                Stage::Idle => return Poll::Ready(Ok(())),
                // The response itself shows whether the client is there.
                Stage::Responding => return Poll::Pending,
                Stage::Receiving(_) | Stage::Processing(_) => {}
            }
            let pauses = self.pauses;
            let pause = self.pause.get_or_insert_with(|| Box::pin(sleep(length(pauses))));
            ready!(pause.as_mut().poll(context));
            (self.pause, self.pauses) = (None, pauses + 1);
            match stage {
                Stage::Processing(Version::HTTP_11) => send_interim_response(context, io)?,
                Stage::Processing(_) if self.pauses < HTTP10_PAUSES => {}
                // The rest of the body cannot arrive any more.
                _ => return Poll::Ready(Ok(())),
            }
        }
    }
}

/// Most responses are ready within the first pause. The second is short: its write fails if the client has reset the
/// connection after the first.
fn length(pauses: u32) -> Duration {
    Duration::from_secs(match pauses {
        0 | 2 => 2,
        1 => 1,
        3 => 4,
        _ => 8,
    })
}

fn send_interim_response<I: AsyncWrite + Unpin>(context: &mut Context<'_>, io: &mut I) -> io::Result<()> {
    match Pin::new(&mut *io).poll_write(context, INTERIM_RESPONSE) {
        Poll::Ready(Ok(sent)) if sent == INTERIM_RESPONSE.len() => {}
        // The rest of the interim response would be lost.
        Poll::Ready(Ok(_)) => return Err(io::ErrorKind::WriteZero.into()),
        Poll::Ready(Err(error)) => return Err(error),
        Poll::Pending => return Ok(()),
    }
    match Pin::new(io).poll_flush(context) {
        Poll::Ready(flushed) => flushed,
        Poll::Pending => Ok(()),
    }
}
