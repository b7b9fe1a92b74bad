//! A peer that has closed its direction of the connection, and may wait for its answer.
//!
//! It is answered as any other. Whether it is still there shows when something is sent: a peer that has gone resets the
//! connection, and the next write fails. So, while an answer is awaited, `100 Continue` is sent now and again, which a
//! client of HTTP/1.1 reads over; a client of HTTP/1.0 would take it for the answer, and has a bounded time instead.

use std::io;
use std::pin::Pin;
use std::task::{Context, Poll, ready};
use std::time::Duration;

use axum::http::Version;
use tokio::io::AsyncWrite;
use tokio::time::{Sleep, sleep};

use crate::process::server::exchange::{Exchange, Stage};

/// What is sent to see whether the peer is there.
const INTERIM: &[u8] = b"HTTP/1.1 100 Continue\r\n\r\n";

/// After so many pauses, 9 s together, a client of HTTP/1.0 is taken to have gone. Less than the usual time for which a
/// request waits for its job: the job of a client that has gone must not be left to itself.
const PAUSES_OF_OLD: u32 = 4;

/// Since when the peer is silent for good.
#[derive(Debug, Default)]
pub(crate) struct HalfClosed {
    pauses: u32,
    pause: Option<Pin<Box<Sleep>>>,
}

impl HalfClosed {
    /// Ready when the end of the stream is to be told to who reads it, or an error that was found.
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
                // Sending it shows whether the peer is there.
                Stage::Answered => return Poll::Pending,
                Stage::Receiving(_) | Stage::Awaited(_) => {}
            }
            let pauses = self.pauses;
            let pause = self.pause.get_or_insert_with(|| Box::pin(sleep(length(pauses))));
            ready!(pause.as_mut().poll(context));
            (self.pause, self.pauses) = (None, pauses + 1);
            match stage {
                Stage::Awaited(Version::HTTP_11) => probe(context, io)?,
                Stage::Awaited(_) if self.pauses < PAUSES_OF_OLD => {}
                // What is missing of a body does not come any more.
                _ => return Poll::Ready(Ok(())),
            }
        }
    }
}

/// Most answers are there within the first pause. The second is short: what is sent then fails if the peer has reset
/// the connection since.
fn length(pauses: u32) -> Duration {
    Duration::from_secs(match pauses {
        0 | 2 => 2,
        1 => 1,
        3 => 4,
        _ => 8,
    })
}

fn probe<I: AsyncWrite + Unpin>(context: &mut Context<'_>, mut io: &mut I) -> io::Result<()> {
    match Pin::new(&mut io).poll_write(context, INTERIM) {
        Poll::Ready(Ok(sent)) if sent == INTERIM.len() => {}
        // What follows would be no HTTP.
        Poll::Ready(Ok(_)) => return Err(io::ErrorKind::WriteZero.into()),
        Poll::Ready(Err(error)) => return Err(error),
        Poll::Pending => return Ok(()),
    }
    match Pin::new(&mut io).poll_flush(context) {
        Poll::Ready(flushed) => flushed,
        Poll::Pending => Ok(()),
    }
}
