//! A stream whose peer must begin in time, and must take what is sent to it. It may close its direction when its
//! request is sent, and what hyper refuses by itself leaves as a document.

use std::io;
use std::pin::Pin;
use std::task::{Context, Poll, ready};
use std::time::Duration;

use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio::time::{Sleep, sleep};
use tokio_util::sync::CancellationToken;

use crate::process::server::connection::Bounds;
use crate::process::server::exchange::Exchange;
use crate::process::server::half_closed::HalfClosed;
use crate::process::server::refusal::{Answering, Head, Refusal};

/// How HTTP/2 begins. Until a byte differs from it or all of it has come, hyper does not know the version and watches no
/// clock; then its own limits hold.
const PREFACE: &[u8] = b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n";

/// The stream.
pub(crate) struct Patient<I> {
    io: I,
    /// Until when it is clear how the peer begins, and how much of the preface has come.
    opening: Option<(Pin<Box<Sleep>>, usize)>,
    /// Cancelled when it begins as HTTP/2 does.
    http2: CancellationToken,
    /// How long the peer may take nothing.
    stall: Duration,
    /// Until when it may, while it takes nothing.
    stalled: Option<Pin<Box<Sleep>>>,
    exchange: Exchange,
    /// The peer has closed its direction.
    half_closed: Option<HalfClosed>,
    /// Answers what hyper refuses.
    answering: Answering,
    /// What it has refused.
    refusal: Option<Refusal>,
    /// The head that is read.
    head: Head,
}

impl<I> Patient<I> {
    /// Within `bounds.header` it must be clear how the peer begins, and `http2` is told if it is HTTP/2; for
    /// `bounds.stall` it may take nothing.
    pub(crate) fn new(
        io: I,
        bounds: Bounds,
        http2: CancellationToken,
        exchange: Exchange,
        answering: Answering,
    ) -> Self {
        let opening = Some((Box::pin(sleep(bounds.header)) as Pin<Box<_>>, 0));
        let (stall, stalled, half_closed, refusal) = (bounds.stall, None, None, None);
        let head = Head::default();
        Self { io, opening, http2, stall, stalled, exchange, half_closed, answering, refusal, head }
    }

    fn has_read(&mut self, bytes: &[u8]) {
        self.head.read(bytes, &self.exchange);
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

    /// Takes what hyper writes where it refuses a request by itself.
    fn is_refusal(&mut self, bytes: &[u8]) -> bool {
        let refusal = Refusal::of(bytes, &self.exchange);
        let is_one = refusal.is_some();
        self.refusal = refusal.or(self.refusal.take());
        is_one
    }
}

impl<I: AsyncRead + AsyncWrite + Unpin> Patient<I> {
    /// Ready when nothing of a refusal is left to send.
    fn poll_refusal(&mut self, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        let Self { io, refusal: Some(refusal), head, answering, .. } = self else {
            return Poll::Ready(Ok(()));
        };
        let poll = refusal.poll_send(context, io, head, answering);
        self.written(context, poll)
    }
}

fn late(what: &str) -> io::Error {
    io::Error::new(io::ErrorKind::TimedOut, what)
}

impl<I: AsyncRead + AsyncWrite + Unpin> AsyncRead for Patient<I> {
    fn poll_read(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        buffer: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        let before = buffer.filled().len();
        if self.half_closed.is_none()
            && let Poll::Ready(read) = Pin::new(&mut self.io).poll_read(context, buffer)
        {
            let bytes = buffer.filled().get(before..).unwrap_or_default();
            self.has_read(bytes);
            if read.is_err() || !bytes.is_empty() {
                return Poll::Ready(read);
            }
            self.half_closed = Some(HalfClosed::default());
        }
        let Self { io, exchange, half_closed, stalled, .. } = &mut *self;
        if let Some(half_closed) = half_closed {
            // Nothing is put between the bytes of an answer, and the end waits for them.
            return if stalled.is_some() {
                Poll::Pending
            } else {
                half_closed.poll_end(context, io, exchange)
            };
        }
        let Some((opening, _)) = &mut self.opening else { return Poll::Pending };
        ready!(opening.as_mut().poll(context));
        Poll::Ready(Err(late("the peer does not begin")))
    }
}

impl<I: AsyncRead + AsyncWrite + Unpin> AsyncWrite for Patient<I> {
    fn poll_write(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        bytes: &[u8],
    ) -> Poll<io::Result<usize>> {
        if self.is_refusal(bytes) {
            return Poll::Ready(Ok(bytes.len()));
        }
        ready!(self.poll_refusal(context))?;
        let poll = Pin::new(&mut self.io).poll_write(context, bytes);
        self.written(context, poll)
    }

    fn poll_flush(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        ready!(self.poll_refusal(context))?;
        let poll = Pin::new(&mut self.io).poll_flush(context);
        self.written(context, poll)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        ready!(self.poll_refusal(context))?;
        let poll = Pin::new(&mut self.io).poll_shutdown(context);
        ready!(self.written(context, poll))?;
        let Self { io, refusal, .. } = &mut *self;
        if let Some(refusal) = refusal {
            ready!(refusal.poll_linger(context, io));
        }
        Poll::Ready(Ok(()))
    }

    fn is_write_vectored(&self) -> bool {
        self.io.is_write_vectored()
    }

    fn poll_write_vectored(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        slices: &[io::IoSlice<'_>],
    ) -> Poll<io::Result<usize>> {
        if let Some(bytes) = slices.first().filter(|bytes| self.is_refusal(bytes)) {
            return Poll::Ready(Ok(bytes.len()));
        }
        ready!(self.poll_refusal(context))?;
        let poll = Pin::new(&mut self.io).poll_write_vectored(context, slices);
        self.written(context, poll)
    }
}
