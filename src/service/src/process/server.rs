//! The listener: connections are accepted within bounds, served, and brought to an end.

pub(crate) mod connection;
pub(crate) mod connection_limit;
pub(crate) mod exchange;
pub(crate) mod fd_limit;
pub(crate) mod half_closed;
pub(crate) mod listener_config;
pub(crate) mod refusal;
pub(crate) mod stall_detection;
pub(crate) mod startup_warnings;
pub(crate) mod timeout_stream;
pub(crate) mod tls;

use crate::process::server::listener_config::Terms;
use crate::process::server::tls::{Tls, TlsError};

use std::io;
use std::net::SocketAddr;
use std::sync::Arc;
use std::time::{Duration, Instant};

use axum::Router;
use futures_util::FutureExt;
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::watch;
use tokio_util::sync::CancellationToken;

use crate::process::server::connection::{Attendant, Bounds};
use crate::process::server::connection_limit::{Full, Places, SPARE};
use crate::telemetry::metrics::connections::Connections;

/// How long nothing is accepted after the system could not, for want of files, say.
const BREATH: Duration = Duration::from_millis(500);

/// Refused connections are logged no more often than this.
const SELDOM: Duration = Duration::from_secs(10);

/// A listener that is ready to serve.
pub(crate) struct Server {
    listeners: Listeners,
    places: Arc<Places>,
    /// For what must be answered when all places are taken.
    spare: Arc<Places>,
    bounds: Bounds,
    tls: Option<Arc<Tls>>,
}

impl Server {
    /// Reads the certificate, where there is one.
    pub(crate) fn new(listeners: Vec<TcpListener>, terms: &Terms) -> Result<Self, TlsError> {
        let tls = match &terms.tls {
            Some([certificate, key]) => Some(Arc::new(Tls::read(certificate, key)?)),
            None => None,
        };
        let places =
            Places::new(crate::process::server::fd_limit::room_for(terms.connections), terms.proxies.clone());
        let spare = Places::new(SPARE, terms.proxies.clone());
        let bounds = Bounds { header: terms.header, stall: terms.stall };
        Ok(Self { listeners: Listeners(listeners), places, spare, bounds, tls })
    }

    /// Says where it listens, and what is open to others.
    pub(crate) fn announce(&self, has_keys: bool) -> io::Result<()> {
        let scheme = if self.tls.is_some() { "https" } else { "http" };
        for listener in &self.listeners.0 {
            let address = listener.local_addr()?;
            tracing::info!("listening on {scheme}://{address}");
            crate::process::server::startup_warnings::warn_if_open(
                address.ip(),
                has_keys,
                self.tls.is_some(),
            );
        }
        Ok(())
    }

    /// Serves until it is to stop; `full` answers one request of each who comes when all places are taken. Then idle
    /// connections are closed at once, and what is open after the limit is cut: a client that reads nothing must not keep
    /// the process.
    pub(crate) async fn serve(
        self,
        router: Router,
        full: Router,
        connections: Connections,
        stopping: &CancellationToken,
        limit: Duration,
    ) {
        let open = watch::Sender::new(());
        let cut = CancellationToken::new();
        let usual = Attendant::new(self.bounds, router, self.tls.clone(), stopping.clone());
        let brief = usual.for_one_request(full);
        let mut refusals = Refusals::default();
        connections.limit(self.places.count());
        let reloading = tokio::spawn(
            cut.clone().run_until_cancelled_owned(crate::process::server::tls::keep_fresh(self.tls)),
        );
        while let Some((stream, peer)) = self.listeners.next(stopping).await {
            let (attendant, place, counted) = match self.places.take(peer.ip()) {
                Ok(place) => (&usual, place, Some(connections.open())),
                Err(full) => {
                    connections.refuse();
                    refusals.log(peer, full);
                    let Ok(place) = self.spare.take(peer.ip()) else { continue };
                    (&brief, place, None)
                }
            };
            let (attended, open) = (attendant.clone().attend(stream, peer, place), open.subscribe());
            let attended = cut.clone().run_until_cancelled_owned(attended);
            tokio::spawn(attended.map(|_| drop((open, counted))));
        }
        drop(self.listeners);
        if tokio::time::timeout(limit, open.closed()).await.is_err() {
            tracing::info!("closing the connections that are still open");
        }
        cut.cancel();
        drop(reloading.await);
    }
}

/// One or two addresses on which the service listens.
struct Listeners(Vec<TcpListener>);

impl Listeners {
    /// The next connection; nothing when the service is to stop. No error of one connection, or of the moment, ends the
    /// listeners.
    async fn next(&self, stopping: &CancellationToken) -> Option<(TcpStream, SocketAddr)> {
        loop {
            match stopping.run_until_cancelled(self.accept()).await? {
                Ok(accepted) => return Some(accepted),
                Err(error) if is_of_one_connection(&error) => {}
                Err(error) => {
                    tracing::error!(%error, "cannot accept connections now");
                    stopping.run_until_cancelled(tokio::time::sleep(BREATH)).await?;
                }
            }
        }
    }

    /// A connection to one of them, whichever it is.
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

/// Beyond the spare places a connection is closed without a word: an answer before the request is lost as often as not. The
/// log says why.
#[derive(Default)]
struct Refusals {
    told: Option<Instant>,
    untold: u64,
}

impl Refusals {
    fn log(&mut self, peer: SocketAddr, full: Full) {
        self.untold += 1;
        if self.told.is_none_or(|told| told.elapsed() >= SELDOM) {
            tracing::warn!(%peer, refused = self.untold, "{full}");
            *self = Self { told: Some(Instant::now()), untold: 0 };
        }
    }
}
