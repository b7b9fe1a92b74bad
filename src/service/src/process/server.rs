//! The listener: it accepts connections up to a limit, serves them, and closes them when the service stops.
//!
//! - `connection`: the handshake and the version of HTTP; then `http1_stream` with `exchange`, `half_closed` and
//!   `rejected_head`, or `http2_activity`.
//! - `connection_limit`, `fd_limit`: the number of connections.
//! - `tls`: the certificate and its reload.
//! - `listener_config`, `startup_warnings`: what the settings say.
//!
//! axum-server does not replace these modules: it has one hyper configuration for all connections, no access to a
//! single connection, and no time limits. Beyond the connection limit the service answers one probe over HTTP/1; it
//! announces the end of an idle HTTP/2 connection; and it needs the socket of a rejected head back.

pub(crate) mod connection;
pub(crate) mod connection_limit;
pub(crate) mod exchange;
pub(crate) mod fd_limit;
pub(crate) mod half_closed;
pub(crate) mod http1_stream;
pub(crate) mod http2_activity;
pub(crate) mod listener_config;
pub(crate) mod rejected_head;
pub(crate) mod startup_warnings;
pub(crate) mod tls;

use std::io;
use std::net::SocketAddr;
use std::sync::Arc;
use std::time::{Duration, Instant};

use axum::Router;
use tokio::net::{TcpListener, TcpStream};
use tokio_util::sync::CancellationToken;
use tokio_util::task::TaskTracker;

use crate::process::server::connection::ConnectionHandler;
use crate::process::server::connection_limit::{ConnectionLimit, ConnectionLimitError, PROBE_CONNECTIONS};
use crate::process::server::fd_limit::raise_for;
use crate::process::server::listener_config::{ListenerConfig, Timeouts};
use crate::process::server::startup_warnings::warn_if_open;
use crate::process::server::tls::{Tls, TlsError, reload_on_change};
use crate::telemetry::metrics::connections::ConnectionMetrics;

/// How long the listener pauses after the system could not accept a connection, for example for lack of files.
const ACCEPT_PAUSE: Duration = Duration::from_millis(500);

/// Minimum time between two lines of the log about rejected connections.
const LOG_INTERVAL: Duration = Duration::from_secs(10);

/// A listener that is ready to serve.
pub(crate) struct Server {
    listeners: Listeners,
    limit: ConnectionLimit,
    /// For connections beyond the limit.
    probe_limit: ConnectionLimit,
    timeouts: Timeouts,
    tls: Option<Arc<Tls>>,
}

impl Server {
    /// Reads the certificate, if the configuration has one.
    pub(crate) fn new(listeners: Vec<TcpListener>, config: &ListenerConfig) -> Result<Self, TlsError> {
        let tls = match &config.tls {
            Some([certificate, key]) => Some(Arc::new(Tls::read(certificate, key)?)),
            None => None,
        };
        Ok(Self {
            listeners: Listeners(listeners),
            limit: ConnectionLimit::new(raise_for(config.connections), config.proxies.clone()),
            probe_limit: ConnectionLimit::new(PROBE_CONNECTIONS, config.proxies.clone()),
            timeouts: config.timeouts,
            tls,
        })
    }

    /// Logs the addresses, and warnings if other machines can reach them.
    pub(crate) fn log_addresses(&self, has_keys: bool) -> io::Result<()> {
        let scheme = if self.tls.is_some() { "https" } else { "http" };
        for listener in &self.listeners.0 {
            let address = listener.local_addr()?;
            tracing::info!("listening on {scheme}://{address}");
            warn_if_open(address.ip(), has_keys, self.tls.is_some());
        }
        Ok(())
    }

    /// Serves `router` until `stopping` is cancelled, and one request of `probes` on each connection beyond the limit.
    /// Then it closes idle connections at once, and all others after `drain`: a client that reads nothing must not
    /// delay the end of the process.
    pub(crate) async fn serve(
        self,
        router: Router,
        probes: Router,
        metrics: ConnectionMetrics,
        stopping: &CancellationToken,
        drain: Duration,
    ) {
        let (tasks, close) = (TaskTracker::new(), CancellationToken::new());
        if let Some(tls) = self.tls.clone() {
            tasks.spawn(stopping.clone().run_until_cancelled_owned(reload_on_change(tls)));
        }
        let handler = ConnectionHandler::new(self.timeouts, router, self.tls, stopping.clone());
        let probe_handler = handler.for_one_request(probes);
        let mut rejections = RejectionLog::default();
        metrics.set_limit(self.limit.total());
        while let Some((stream, peer)) = self.listeners.next(stopping).await {
            let (handler, share, counted) = match self.limit.take(peer.ip()) {
                Ok(share) => (&handler, share, Some(metrics.open())),
                Err(error) => {
                    metrics.count_rejection();
                    rejections.log(peer, error);
                    // Without a response: the client would usually lose one that is sent before its request.
                    let Ok(share) = self.probe_limit.take(peer.ip()) else { continue };
                    (&probe_handler, share, None)
                }
            };
            let (connection, close) = (handler.clone().run(stream, peer), close.clone());
            tasks.spawn(async move {
                close.run_until_cancelled(connection).await;
                drop((share, counted));
            });
        }
        drop(self.listeners);
        tasks.close();
        if tokio::time::timeout(drain, tasks.wait()).await.is_err() {
            tracing::info!("closing the connections that are still open");
        }
        close.cancel();
    }
}

/// One or two addresses on which the service listens.
struct Listeners(Vec<TcpListener>);

impl Listeners {
    /// The next connection; `None` when the service stops. Errors do not end the listeners.
    async fn next(&self, stopping: &CancellationToken) -> Option<(TcpStream, SocketAddr)> {
        loop {
            match stopping.run_until_cancelled(self.accept()).await? {
                Ok(accepted) => return Some(accepted),
                Err(error) if is_of_one_connection(&error) => {}
                Err(error) => {
                    tracing::error!(%error, "cannot accept connections now");
                    stopping.run_until_cancelled(tokio::time::sleep(ACCEPT_PAUSE)).await?;
                }
            }
        }
    }

    async fn accept(&self) -> io::Result<(TcpStream, SocketAddr)> {
        let on = async |listener: Option<&TcpListener>| match listener {
            Some(listener) => listener.accept().await,
            None => std::future::pending().await,
        };
        tokio::select! {
            accepted = on(self.0.first()) => accepted,
            accepted = on(self.0.get(1)) => accepted,
        }
    }
}

fn is_of_one_connection(error: &io::Error) -> bool {
    use io::ErrorKind::{ConnectionAborted, ConnectionRefused, ConnectionReset, Interrupted};
    matches!(error.kind(), ConnectionAborted | ConnectionRefused | ConnectionReset | Interrupted)
}

/// Logs rejected connections, several in one line.
#[derive(Default)]
struct RejectionLog {
    logged: Option<Instant>,
    rejected: u64,
}

impl RejectionLog {
    fn log(&mut self, peer: SocketAddr, error: ConnectionLimitError) {
        self.rejected += 1;
        if self.logged.is_none_or(|logged| logged.elapsed() >= LOG_INTERVAL) {
            tracing::warn!(%peer, refused = self.rejected, "{error}");
            *self = Self { logged: Some(Instant::now()), rejected: 0 };
        }
    }
}
