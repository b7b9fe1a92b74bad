//! Answers on their way: a peer that does not go on taking one is found out.
//!
//! Over HTTP/2 a peer can hold one answer back while the connection lives on: nothing that is written to the socket shows
//! it. So the bytes of each answer tell when they are taken.

use std::pin::Pin;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError, Weak};
use std::task::{Context, Poll, ready};
use std::time::{Duration, Instant};

use axum::body::{Body, Bytes};
use hyper::body::{Body as HttpBody, Buf, Frame, SizeHint};
use tokio::sync::watch;

use crate::process::server::exchange::Exchange;

/// More answers than this under way, and those that have arrived are forgotten first.
const MANY: usize = 256;

/// The answers of one connection.
#[derive(Debug, Default)]
pub(crate) struct Outgoing {
    answers: Mutex<Vec<Weak<Progress>>>,
    under_way: watch::Sender<usize>,
    exchange: Exchange,
}

/// A request, from when it is there until the last byte of its answer is taken.
#[derive(Debug)]
pub(crate) struct UnderWay {
    count: watch::Sender<usize>,
    exchange: Exchange,
}

/// How far one answer is.
#[derive(Debug)]
struct Progress {
    begun: Instant,
    /// When bytes were last handed over or taken, milliseconds after the beginning.
    moved: AtomicU64,
    /// What is handed over and not taken yet.
    waiting: AtomicUsize,
    _under_way: UnderWay,
}

impl Outgoing {
    /// How far the exchange over HTTP/1 is.
    pub(crate) fn exchange(&self) -> &Exchange {
        &self.exchange
    }

    /// A request has come.
    pub(crate) fn begin(&self) -> UnderWay {
        self.under_way.send_modify(|under_way| *under_way += 1);
        UnderWay { count: self.under_way.clone(), exchange: self.exchange.clone() }
    }

    /// Watches the body of a request's answer from now on.
    pub(crate) fn watch(&self, body: Body, request: UnderWay) -> Watched {
        self.exchange.answer();
        let (moved, waiting) = (AtomicU64::new(0), AtomicUsize::new(0));
        let progress = Arc::new(Progress { begun: Instant::now(), moved, waiting, _under_way: request });
        let mut all = self.answers.lock().unwrap_or_else(PoisonError::into_inner);
        if all.len() >= MANY {
            all.retain(|progress| progress.strong_count() > 0);
        }
        all.push(Arc::downgrade(&progress));
        Watched { body, progress, handed_over: false }
    }

    /// Returns when no request has been under way for so long.
    pub(crate) async fn idle(&self, limit: Duration) {
        let mut under_way = self.under_way.subscribe();
        // The sender lives as long as this does.
        while under_way.wait_for(|under_way| *under_way == 0).await.is_ok() {
            if tokio::time::timeout(limit, under_way.changed()).await.is_err() {
                return;
            }
        }
    }

    /// Returns when the peer has taken nothing of an answer for so long, or up to half as long again.
    pub(crate) async fn stalled(&self, limit: Duration) {
        loop {
            tokio::time::sleep(limit / 2).await;
            let mut all = self.answers.lock().unwrap_or_else(PoisonError::into_inner);
            all.retain(|progress| progress.strong_count() > 0);
            if all.iter().filter_map(Weak::upgrade).any(|progress| progress.has_stalled(limit)) {
                return;
            }
        }
    }
}

impl Drop for UnderWay {
    fn drop(&mut self) {
        self.exchange.end();
        self.count.send_modify(|under_way| *under_way -= 1);
    }
}

impl Progress {
    fn hand_over(&self) {
        self.waiting.fetch_add(1, Ordering::Relaxed);
        self.moved();
    }

    fn take(&self) {
        self.waiting.fetch_sub(1, Ordering::Relaxed);
        self.moved();
    }

    fn moved(&self) {
        let now = u64::try_from(self.begun.elapsed().as_millis()).unwrap_or(u64::MAX);
        self.moved.store(now, Ordering::Relaxed);
    }

    fn has_stalled(&self, limit: Duration) -> bool {
        let moved = Duration::from_millis(self.moved.load(Ordering::Relaxed));
        self.waiting.load(Ordering::Relaxed) > 0 && self.begun.elapsed().saturating_sub(moved) >= limit
    }
}

/// A body that is watched.
#[derive(Debug)]
pub(crate) struct Watched {
    body: Body,
    progress: Arc<Progress>,
    /// A frame was handed over, and the next is not asked for yet: the peer is not ready for it.
    handed_over: bool,
}

impl Watched {
    fn asked_again(&mut self) {
        if std::mem::take(&mut self.handed_over) {
            self.progress.take();
        }
    }
}

impl HttpBody for Watched {
    type Data = Parcel;
    type Error = axum::Error;

    fn poll_frame(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Parcel>, axum::Error>>> {
        self.asked_again();
        let frame = ready!(Pin::new(&mut self.body).poll_frame(context));
        if let Some(Ok(_)) = frame {
            self.progress.hand_over();
            self.handed_over = true;
        }
        let parcel = |bytes| Parcel::new(bytes, Arc::clone(&self.progress));
        Poll::Ready(frame.map(|frame| frame.map(|frame| frame.map_data(parcel))))
    }

    fn is_end_stream(&self) -> bool {
        self.body.is_end_stream()
    }

    fn size_hint(&self) -> SizeHint {
        self.body.size_hint()
    }
}

impl Drop for Watched {
    fn drop(&mut self) {
        self.asked_again();
    }
}

/// Bytes that tell when they are taken.
#[derive(Debug)]
pub(crate) struct Parcel {
    bytes: Bytes,
    progress: Arc<Progress>,
}

impl Parcel {
    fn new(bytes: Bytes, progress: Arc<Progress>) -> Self {
        progress.hand_over();
        Self { bytes, progress }
    }
}

impl Buf for Parcel {
    fn remaining(&self) -> usize {
        self.bytes.remaining()
    }

    fn chunk(&self) -> &[u8] {
        self.bytes.chunk()
    }

    fn advance(&mut self, count: usize) {
        self.bytes.advance(count);
        self.progress.moved();
    }
}

impl Drop for Parcel {
    fn drop(&mut self) {
        self.progress.take();
    }
}
