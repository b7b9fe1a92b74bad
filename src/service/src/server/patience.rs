//! A stream whose peer must begin in time, and must take what is sent to it.

use std::io;
use std::pin::Pin;
use std::task::{Context, Poll, ready};
use std::time::Duration;

use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio::time::{Sleep, sleep};
use tokio_util::sync::CancellationToken;

/// How HTTP/2 begins. Until a byte differs from it or all of it has come, hyper does not know the version and watches no
/// clock; then its own limits hold.
const PREFACE: &[u8] = b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n";

/// The stream.
pub(super) struct Patient<I> {
    io: I,
    /// Until when it is clear how the peer begins, and how much of the preface has come.
    opening: Option<(Pin<Box<Sleep>>, usize)>,
    /// Cancelled when it begins as HTTP/2 does.
    http2: CancellationToken,
    /// How long the peer may take nothing.
    stall: Duration,
    /// Until when it may, while it takes nothing.
    stalled: Option<Pin<Box<Sleep>>>,
}

impl<I> Patient<I> {
    /// Within `opening` it must be clear how the peer begins, and `http2` is told if it is HTTP/2; for `stall` it may take
    /// nothing.
    pub(super) fn new(io: I, opening: Duration, http2: CancellationToken, stall: Duration) -> Self {
        Self { io, opening: Some((Box::pin(sleep(opening)), 0)), http2, stall, stalled: None }
    }

    fn has_read(&mut self, bytes: &[u8]) {
        let Some((_, matched)) = &mut self.opening else { return };
        let expected = PREFACE.get(*matched..).unwrap_or_default();
        *matched += bytes.len();
        let is_whole = *matched >= PREFACE.len();
        let differs = !(expected.starts_with(bytes) || bytes.starts_with(expected));
        if is_whole && !differs {
            self.http2.cancel();
        }
        if is_whole || differs {
            self.opening = None;
        }
    }

    /// What came of writing: an error in place of waiting any longer.
    fn written<T>(&mut self, context: &mut Context<'_>, poll: Poll<io::Result<T>>) -> Poll<io::Result<T>> {
        if poll.is_ready() {
            self.stalled = None;
            return poll;
        }
        let stall = self.stall;
        let stalled = self.stalled.get_or_insert_with(|| Box::pin(sleep(stall)));
        ready!(stalled.as_mut().poll(context));
        Poll::Ready(Err(late("the peer takes nothing")))
    }
}

fn late(what: &str) -> io::Error {
    io::Error::new(io::ErrorKind::TimedOut, what)
}

impl<I: AsyncRead + Unpin> AsyncRead for Patient<I> {
    fn poll_read(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        buffer: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        let before = buffer.filled().len();
        if let Poll::Ready(read) = Pin::new(&mut self.io).poll_read(context, buffer) {
            self.has_read(buffer.filled().get(before..).unwrap_or_default());
            return Poll::Ready(read);
        }
        let Some((opening, _)) = &mut self.opening else { return Poll::Pending };
        ready!(opening.as_mut().poll(context));
        Poll::Ready(Err(late("the peer does not begin")))
    }
}

impl<I: AsyncWrite + Unpin> AsyncWrite for Patient<I> {
    fn poll_write(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        bytes: &[u8],
    ) -> Poll<io::Result<usize>> {
        let poll = Pin::new(&mut self.io).poll_write(context, bytes);
        self.written(context, poll)
    }

    fn poll_flush(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        let poll = Pin::new(&mut self.io).poll_flush(context);
        self.written(context, poll)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        let poll = Pin::new(&mut self.io).poll_shutdown(context);
        self.written(context, poll)
    }

    fn is_write_vectored(&self) -> bool {
        self.io.is_write_vectored()
    }

    fn poll_write_vectored(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        slices: &[io::IoSlice<'_>],
    ) -> Poll<io::Result<usize>> {
        let poll = Pin::new(&mut self.io).poll_write_vectored(context, slices);
        self.written(context, poll)
    }
}
