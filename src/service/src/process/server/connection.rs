//! One connection: the TLS handshake, then HTTP/1 or HTTP/2 until the connection ends.
//!
//! hyper limits the time for the headers of HTTP/1 and the number of streams of HTTP/2. This module limits what hyper
//! does not: the time until the version of HTTP is known, and the time without a request over HTTP/2.

use std::convert::Infallible;
use std::future::Future;
use std::io::{self, Cursor};
use std::net::SocketAddr;
use std::pin::pin;
use std::sync::Arc;

use axum::Router;
use axum::body::Body;
use axum::extract::ConnectInfo;
use axum::http::{Request, Response};
use hyper::body::Incoming;
use hyper::server::conn::{http1, http2};
use hyper::service::service_fn;
use hyper_util::rt::{TokioExecutor, TokioIo, TokioTimer};
use tokio::io::{AsyncRead, AsyncReadExt, AsyncWrite};
use tokio::net::TcpStream;
use tokio::time::timeout;
use tokio_util::sync::CancellationToken;
use tower::ServiceExt;

use crate::http::request_head;
use crate::http::request_head::HYPER_HEAD_BYTES;
use crate::process::server::exchange::Exchange;
use crate::process::server::http1_stream::Http1Stream;
use crate::process::server::http2_activity::Http2Activity;
use crate::process::server::listener_config::Timeouts;
use crate::process::server::tls::Tls;

/// The first bytes of a client that speaks HTTP/2 without TLS.
const HTTP2_PREFACE: &[u8] = b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n";

/// Maximum number of concurrent requests on one connection.
const MAX_STREAMS: u32 = 100;

/// Maximum number of streams of one connection that the client has reset and hyper has not processed yet, or that hyper
/// has reset. Beyond it hyper closes the connection.
const MAX_RESETS: usize = 32;

/// Serves connections.
#[derive(Clone)]
pub(crate) struct ConnectionHandler {
    timeouts: Timeouts,
    http1: http1::Builder,
    http2: http2::Builder<TokioExecutor>,
    router: Router,
    tls: Option<Arc<Tls>>,
    one_request: bool,
    stopping: CancellationToken,
}

impl ConnectionHandler {
    /// Serves `router` until `stopping` is cancelled.
    pub(crate) fn new(
        timeouts: Timeouts,
        router: Router,
        tls: Option<Arc<Tls>>,
        stopping: CancellationToken,
    ) -> Self {
        let mut http1 = http1::Builder::new();
        http1
            .timer(TokioTimer::new())
            .header_read_timeout(timeouts.header)
            .max_buf_size(HYPER_HEAD_BYTES.into());
        let mut http2 = http2::Builder::new(TokioExecutor::new());
        http2
            .timer(TokioTimer::new())
            .max_header_list_size(HYPER_HEAD_BYTES.into())
            .max_concurrent_streams(MAX_STREAMS)
            .max_pending_accept_reset_streams(MAX_RESETS)
            .max_local_error_reset_streams(MAX_RESETS)
            .keep_alive_interval(timeouts.header)
            .keep_alive_timeout(timeouts.header);
        Self { timeouts, http1, http2, router, tls, one_request: false, stopping }
    }

    /// A handler that serves one HTTP/1 request of `router` per connection, within the time for headers.
    pub(crate) fn for_one_request(&self, router: Router) -> Self {
        let mut http1 = self.http1.clone();
        http1.keep_alive(false);
        Self { http1, router, one_request: true, ..self.clone() }
    }

    /// Serves one connection until it ends.
    pub(crate) async fn run(self, stream: TcpStream, peer: SocketAddr) {
        let header = self.timeouts.header;
        if self.one_request {
            drop(timeout(header, self.accept(stream, peer)).await);
        } else {
            self.accept(stream, peer).await;
        }
    }

    async fn accept(self, stream: TcpStream, peer: SocketAddr) {
        // hyper writes a response in one piece, so a delay would not join packets.
        drop(stream.set_nodelay(true));
        if let Some(tls) = self.tls.clone() {
            let handshake = tls.accept(stream, !self.one_request);
            if let Some((stream, is_http2)) = self.in_header_time(handshake, peer).await {
                self.serve(stream, is_http2, peer).await;
            }
            return;
        }
        let (mut reader, writer) = stream.into_split();
        let start = if self.one_request {
            Some((Vec::new(), false))
        } else {
            self.in_header_time(read_start(&mut reader), peer).await
        };
        if let Some((start, is_http2)) = start {
            let stream = tokio::io::join(Cursor::new(start).chain(reader), writer);
            self.serve(stream, is_http2, peer).await;
        }
    }

    /// The output of the first step of a connection. `None`: the step failed or took too long, or the service stops.
    async fn in_header_time<T>(
        &self,
        step: impl Future<Output = io::Result<T>>,
        peer: SocketAddr,
    ) -> Option<T> {
        let step = timeout(self.timeouts.header, step);
        match self.stopping.run_until_cancelled(step).await? {
            Ok(Ok(output)) => return Some(output),
            Ok(Err(error)) => tracing::debug!(%peer, %error, "a connection failed at its start"),
            Err(_) => tracing::debug!(%peer, "a connection took too long to start"),
        }
        None
    }

    async fn serve<I>(self, stream: I, is_http2: bool, peer: SocketAddr)
    where
        I: AsyncRead + AsyncWrite + Unpin + Send + 'static,
    {
        // Boxed: a connection then has only the memory of its own version of HTTP.
        let served = if is_http2 {
            Box::pin(self.serve_http2(stream, peer)).await
        } else {
            Box::pin(self.serve_http1(stream, peer)).await
        };
        if let Err(error) = served {
            tracing::debug!(%peer, %error, "a connection failed");
        }
    }

    async fn serve_http1<I>(self, stream: I, peer: SocketAddr) -> hyper::Result<()>
    where
        I: AsyncRead + AsyncWrite + Unpin,
    {
        let exchange = Exchange::default();
        let stream = Http1Stream::new(stream, self.timeouts.stall, exchange.clone());
        let router = self.router.clone();
        let service = service_fn(move |request| {
            // At once: the stream needs to know of the request before it reads the end of the client's direction.
            let request = exchange.begin(request);
            let (response, exchange) = (respond(router.clone(), request, peer), exchange.clone());
            async move { Ok::<_, Infallible>(response.await?.map(|body| exchange.respond(body))) }
        });
        let mut connection = self.http1.serve_connection(TokioIo::new(stream), service);
        let served = tokio::select! {
            served = &mut connection => served,
            () = self.stopping.cancelled() => {
                Pin::new(&mut connection).graceful_shutdown();
                (&mut connection).await
            }
        };
        let stream = connection.into_parts().io.into_inner();
        if let Some((stream, rejected)) = stream.into_rejected() {
            let answer = rejected.answer(stream, self.router, peer);
            drop(timeout(self.timeouts.stall, answer).await);
        }
        served
    }

    async fn serve_http2<I>(self, stream: I, peer: SocketAddr) -> hyper::Result<()>
    where
        I: AsyncRead + AsyncWrite + Unpin + Send + 'static,
    {
        let activity = Arc::new(Http2Activity::default());
        let (router, requests) = (self.router, Arc::clone(&activity));
        let service = service_fn(move |request: Request<Incoming>| {
            let request_in_progress = requests.begin();
            let response = respond(router.clone(), request.map(Body::new), peer);
            async move { Ok::<_, Infallible>(response.await?.map(|body| request_in_progress.watch(body))) }
        });
        let Timeouts { header, stall } = self.timeouts;
        let mut connection = pin!(self.http2.serve_connection(TokioIo::new(stream), service));
        let served = async {
            tokio::select! {
                served = connection.as_mut() => return served,
                () = self.stopping.cancelled() => {}
                () = activity.idle(header) => {}
            }
            connection.as_mut().graceful_shutdown();
            connection.await
        };
        tokio::select! {
            served = served => return served,
            // A client can ignore the announcement that the connection ends.
            () = activity.idle(2 * header) => tracing::debug!(%peer, "closed an idle connection"),
            () = activity.stalled(stall) => tracing::debug!(%peer, "closed a stalled connection"),
        }
        Ok(())
    }
}

/// Reads the first bytes of a connection without TLS, and decides whether the client speaks HTTP/2.
async fn read_start(reader: &mut (impl AsyncRead + Unpin)) -> io::Result<(Vec<u8>, bool)> {
    let mut start = Vec::with_capacity(HTTP2_PREFACE.len());
    while start.len() < HTTP2_PREFACE.len() && HTTP2_PREFACE.starts_with(&start) {
        let missing = (HTTP2_PREFACE.len() - start.len()) as u64;
        if (&mut *reader).take(missing).read_buf(&mut start).await? == 0 {
            break;
        }
    }
    let is_http2 = start == HTTP2_PREFACE;
    Ok((start, is_http2))
}

async fn respond(
    router: Router,
    mut request: Request<Body>,
    peer: SocketAddr,
) -> Result<Response<Body>, Infallible> {
    request_head::check(&mut request);
    request.extensions_mut().insert(ConnectInfo(peer));
    router.oneshot(request).await
}
