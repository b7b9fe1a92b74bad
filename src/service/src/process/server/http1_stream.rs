//! The stream of an HTTP/1 connection, between the socket and hyper. It does what hyper has no setting for:
//!
//! - It fails if the client reads nothing of a response for too long. hyper would wait forever.
//! - It hides from hyper that a client has closed its direction after a request. hyper would cancel the request.
//! - It suppresses the empty response with which hyper rejects a head; [`RejectedHead`] sends a problem document.

use std::future::Future;
use std::io;
use std::pin::Pin;
use std::task::{Context, Poll, ready};
use std::time::Duration;

use axum::http::StatusCode;
use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio::time::{Sleep, sleep};

use crate::process::server::exchange::{Exchange, Stage};
use crate::process::server::half_closed::HalfClosed;
use crate::process::server::rejected_head::{RejectedHead, bare_status};

/// The stream.
pub(crate) struct Http1Stream<I> {
    io: I,
    exchange: Exchange,
    /// How long a write may wait for the client.
    stall: Duration,
    /// When the write that waits fails.
    write_timeout: Option<Pin<Box<Sleep>>>,
    /// The client has closed its direction.
    half_closed: Option<HalfClosed>,
    /// The status with which hyper has rejected a head.
    rejected: Option<StatusCode>,
}

impl<I> Http1Stream<I> {
    /// Writes fail if the client reads nothing for `stall`.
    pub(crate) fn new(io: I, stall: Duration, exchange: Exchange) -> Self {
        Self { io, exchange, stall, write_timeout: None, half_closed: None, rejected: None }
    }

    /// The socket and the head that hyper has rejected, if hyper has.
    pub(crate) fn into_rejected(self) -> Option<(I, RejectedHead)> {
        let status = self.rejected?;
        Some((self.io, RejectedHead::new(status, self.exchange.take_head())))
    }

    /// Replaces a write that waits too long by an error.
    fn limited<T>(&mut self, context: &mut Context<'_>, poll: Poll<io::Result<T>>) -> Poll<io::Result<T>> {
        if poll.is_ready() {
            self.write_timeout = None;
            return poll;
        }
        let stall = self.stall;
        let timeout = self.write_timeout.get_or_insert_with(|| Box::pin(sleep(stall)));
        ready!(timeout.as_mut().poll(context));
        Poll::Ready(Err(io::Error::new(io::ErrorKind::TimedOut, "the client reads nothing")))
    }

    /// Whether hyper rejects a head with these bytes; they must not be sent then.
    fn is_rejection(&mut self, bytes: &[u8]) -> bool {
        if self.exchange.stage() == Stage::Idle
            && let Some(status) = bare_status(bytes)
        {
            self.rejected = Some(status);
        }
        self.rejected.is_some()
    }
}

impl<I: AsyncRead + AsyncWrite + Unpin> AsyncRead for Http1Stream<I> {
    fn poll_read(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        buffer: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        let this = &mut *self;
        if this.half_closed.is_none() {
            let before = buffer.filled().len();
            let read = ready!(Pin::new(&mut this.io).poll_read(context, buffer));
            let bytes = buffer.filled().get(before..).unwrap_or_default();
            this.exchange.read(bytes);
            if read.is_err() || !bytes.is_empty() {
                return Poll::Ready(read);
            }
        }
        // A part of the response has been written: an interim response must not follow.
        if this.write_timeout.is_some() {
            return Poll::Pending;
        }
        let half_closed = this.half_closed.get_or_insert_default();
        half_closed.poll_end(context, &mut this.io, &this.exchange)
    }
}

impl<I: AsyncWrite + Unpin> AsyncWrite for Http1Stream<I> {
    fn poll_write(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        bytes: &[u8],
    ) -> Poll<io::Result<usize>> {
        if self.is_rejection(bytes) {
            return Poll::Ready(Ok(bytes.len()));
        }
        let poll = Pin::new(&mut self.io).poll_write(context, bytes);
        self.limited(context, poll)
    }

    fn poll_write_vectored(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        slices: &[io::IoSlice<'_>],
    ) -> Poll<io::Result<usize>> {
        if let Some(bytes) = slices.first().filter(|bytes| self.is_rejection(bytes)) {
            return Poll::Ready(Ok(bytes.len()));
        }
        let poll = Pin::new(&mut self.io).poll_write_vectored(context, slices);
        self.limited(context, poll)
    }

    fn is_write_vectored(&self) -> bool {
        self.io.is_write_vectored()
    }

    fn poll_flush(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        let poll = Pin::new(&mut self.io).poll_flush(context);
        self.limited(context, poll)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        if self.rejected.is_some() {
            return Poll::Ready(Ok(()));
        }
        let poll = Pin::new(&mut self.io).poll_shutdown(context);
        self.limited(context, poll)
    }
}
