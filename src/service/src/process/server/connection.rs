//! One connection: the handshake, then HTTP/1 or HTTP/2 within bounds.

use std::convert::Infallible;
use std::net::SocketAddr;
use std::pin::pin;
use std::sync::Arc;
use std::time::{Duration, SystemTime};

use axum::Router;
use axum::body::{Body, to_bytes};
use axum::extract::ConnectInfo;
use axum::http::header::{CONNECTION, CONTENT_LENGTH, ORIGIN};
use axum::http::{HeaderValue, Request, Response, StatusCode};
use headers::{Date, HeaderMapExt};
use hyper::service::service_fn;
use hyper_util::rt::{TokioExecutor, TokioIo, TokioTimer};
use hyper_util::server::conn::auto::Builder;
use tokio::io::{AsyncRead, AsyncWrite};
use tokio::net::TcpStream;
use tokio_util::sync::CancellationToken;
use tower::ServiceExt;

use crate::http::request_head;
use crate::http::request_head::READ_BYTES;
use crate::process::server::connection_limit::Place;
use crate::process::server::exchange::Arriving;
use crate::process::server::refusal::Making;
use crate::process::server::stall_detection::{Outgoing, UnderWay, Watched};
use crate::process::server::timeout_stream::Patient;
use crate::process::server::tls::Tls;

/// Most requests at once on one connection.
const STREAMS: u32 = 100;

/// Most requests on one connection that were taken back before they were looked at, or that were answered by a reset;
/// then the connection is closed.
const RESETS: usize = 32;

/// Most bytes of the document of a refusal.
const REFUSAL_BYTES: usize = 64 * 1024;

/// How long a peer may take for what.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    /// For a request's headers, for the handshake, for the next request, for the answer to a ping.
    pub header: Duration,
    /// For the next byte of an answer.
    pub stall: Duration,
}

/// Attends to connections.
#[derive(Clone)]
pub(crate) struct Attendant {
    bounds: Bounds,
    builder: Builder<TokioExecutor>,
    router: Router,
    tls: Option<Arc<Tls>>,
    one_request: bool,
    stopping: CancellationToken,
}

impl Attendant {
    /// Serves `router`.
    pub(crate) fn new(
        bounds: Bounds,
        router: Router,
        tls: Option<Arc<Tls>>,
        stopping: CancellationToken,
    ) -> Self {
        let mut builder = Builder::new(TokioExecutor::new());
        builder
            .http1()
            .timer(TokioTimer::new())
            .header_read_timeout(bounds.header)
            .max_buf_size(READ_BYTES.into());
        builder
            .http2()
            .timer(TokioTimer::new())
            .max_header_list_size(READ_BYTES.into())
            .max_concurrent_streams(STREAMS)
            .max_pending_accept_reset_streams(RESETS)
            .max_local_error_reset_streams(RESETS)
            .keep_alive_interval(bounds.header)
            .keep_alive_timeout(bounds.header);
        Self { bounds, builder, router, tls, one_request: false, stopping }
    }

    /// Serves `router` in the same way, but one request on a connection, over HTTP/1, and in the time of its headers.
    pub(crate) fn for_one_request(&self, router: Router) -> Self {
        let mut builder = self.builder.clone();
        builder.http1().keep_alive(false);
        Self { builder, router, one_request: true, ..self.clone() }
    }

    /// Serves a connection to its end. Failures are the peer's affair.
    pub(crate) async fn attend(self, stream: TcpStream, peer: SocketAddr, place: Place) {
        if self.one_request {
            let limit = self.bounds.header;
            drop(tokio::time::timeout(limit, self.open(stream, peer)).await);
        } else {
            self.open(stream, peer).await;
        }
        drop(place);
    }

    async fn open(self, stream: TcpStream, peer: SocketAddr) {
        // An answer is written whole: nothing is won by waiting for more of it.
        drop(stream.set_nodelay(true));
        if let Some(tls) = self.tls.clone() {
            let shaking = tokio::time::timeout(self.bounds.header, tls.accept(stream, !self.one_request));
            match self.stopping.run_until_cancelled(shaking).await {
                Some(Ok(Ok((stream, http2)))) => self.serve(stream, Some(http2), peer).await,
                Some(Ok(Err(error))) => tracing::debug!(%peer, %error, "the TLS handshake failed"),
                Some(Err(_)) | None => tracing::debug!(%peer, "the TLS handshake timed out"),
            }
        } else {
            let http2 = self.one_request.then_some(false);
            self.serve(stream, http2, peer).await;
        }
    }

    /// HTTP/2 or not, where that is settled: over TLS it was agreed on.
    async fn serve<I>(self, stream: I, http2: Option<bool>, peer: SocketAddr)
    where
        I: AsyncRead + AsyncWrite + Unpin + Send + 'static,
    {
        let Self { bounds, builder, router, stopping, .. } = self;
        let builder = match http2 {
            None => builder,
            Some(true) => builder.http2_only(),
            Some(false) => builder.http1_only(),
        };
        let http2 = CancellationToken::new();
        let outgoing = Arc::new(Outgoing::default());
        let (exchange, refusing) = (outgoing.exchange().clone(), router.clone());
        let answering = Arc::new(move |status, origin| refuse(refusing.clone(), status, origin, peer));
        let io = TokioIo::new(Patient::new(stream, bounds, http2.clone(), exchange, answering));
        let watching = Arc::clone(&outgoing);
        let service = service_fn(move |request| {
            // Before anything else is read: the peer may have closed its direction.
            let (under_way, request) = (watching.begin(), watching.exchange().begin(request));
            answer(router.clone(), request, peer, Arc::clone(&watching), under_way)
        });
        // Over HTTP/1 hyper watches the time until the next request.
        let idle = async {
            http2.cancelled().await;
            outgoing.idle(bounds.header).await;
        };
        let served = async {
            let mut connection = pin!(builder.serve_connection(io, service));
            tokio::select! {
                served = connection.as_mut() => return served,
                () = stopping.cancelled() => {}
                () = idle => {}
            }
            connection.as_mut().graceful_shutdown();
            connection.await
        };
        // A peer can put off even the end that was announced to it.
        let unused = async {
            http2.cancelled().await;
            outgoing.idle(bounds.header).await;
            outgoing.idle(bounds.stall).await;
        };
        tokio::select! {
            served = served => {
                if let Err(error) = served {
                    tracing::debug!(%peer, %error, "a connection failed");
                }
            }
            () = unused => tracing::debug!(%peer, "closed an idle connection"),
            () = outgoing.stalled(bounds.stall) => tracing::debug!(%peer, "closed a stalled connection"),
        }
    }
}

async fn answer(
    router: Router,
    mut request: Request<Arriving>,
    peer: SocketAddr,
    outgoing: Arc<Outgoing>,
    under_way: UnderWay,
) -> Result<Response<Watched>, Infallible> {
    request_head::check(&mut request);
    request.extensions_mut().insert(ConnectInfo(peer));
    let response = router.oneshot(request.map(Body::new)).await?;
    Ok(response.map(|body| outgoing.watch(body, under_way)))
}

/// The bytes of the answer to what hyper has refused over HTTP/1. The connection ends with it.
fn refuse(router: Router, status: StatusCode, origin: Option<HeaderValue>, peer: SocketAddr) -> Making {
    let mut request: Request<Body> = request_head::refused(status);
    request.headers_mut().extend(origin.map(|origin| (ORIGIN, origin)));
    request.extensions_mut().insert(ConnectInfo(peer));
    Box::pin(async move {
        let Ok(response) = router.oneshot(request).await;
        let (mut parts, body) = response.into_parts();
        let body = to_bytes(body, REFUSAL_BYTES).await.unwrap_or_default();
        parts.headers.insert(CONNECTION, HeaderValue::from_static("close"));
        parts.headers.insert(CONTENT_LENGTH, body.len().into());
        parts.headers.typed_insert(Date::from(SystemTime::now()));
        let reason = parts.status.canonical_reason().unwrap_or_default();
        let mut bytes = format!("HTTP/1.1 {} {reason}\r\n", parts.status.as_str()).into_bytes();
        for (name, value) in &parts.headers {
            for part in [name.as_str().as_bytes(), b": ", value.as_bytes(), b"\r\n"] {
                bytes.extend_from_slice(part);
            }
        }
        bytes.extend_from_slice(b"\r\n");
        bytes.extend_from_slice(&body);
        bytes
    })
}
