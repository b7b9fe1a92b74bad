//! Puts the service together, and runs it until it is told to stop.

use std::fmt;
use std::pin::pin;
use std::sync::Arc;
use std::time::Duration;

use axum::Router;
use moka::future::Cache;
use tokio::net::TcpListener;
use tokio_util::sync::CancellationToken;
use utoipa_swagger_ui::{Config, SwaggerUi};

use crate::http::allowed_origins::Pages;
use crate::http::gate::Gate;
use crate::http::handlers::service;
use crate::http::readiness::Readiness;
use crate::http::security_headers::Browsers;
use crate::http::state::{ESTIMATES, Shared, State};
use crate::http::{base_path, middleware, router, security_headers, viewer};
use crate::limits::admission::Admission;
use crate::limits::keys_file::BadKeys;
use crate::limits::rate::Rate;
use crate::operations::compute_pool::leave_one_core_free;
use crate::operations::machine_registry::{MachineFileError, MachineRegistry};
use crate::process::config::ServeConfig;
use crate::process::config::listen::Listen;
use crate::process::server::Server;
use crate::process::server::listener_config::Terms;
use crate::process::server::tls::TlsError;
use crate::process::signals::{outlive_hangups, told_to_stop};
use crate::process::storage::{Storage, StorageError};
use crate::telemetry::metrics::Metrics;

/// Why the service cannot run.
#[derive(Debug)]
pub enum StartError {
    /// A machine's file.
    Machine(MachineFileError),
    /// The file of keys.
    Keys(BadKeys),
    /// Where jobs and results are kept.
    Storage(StorageError),
    /// The certificate.
    Tls(TlsError),
    /// The address.
    Listen(Listen, std::io::Error),
}

impl fmt::Display for StartError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Machine(bad) => write!(f, "machines: {bad}"),
            Self::Keys(bad) => write!(f, "keys: {bad}"),
            Self::Storage(error) => error.fmt(f),
            Self::Tls(error) => write!(f, "tls_certificate, tls_key: {error}"),
            Self::Listen(address, error) => write!(f, "listen: cannot serve on {address}: {error}"),
        }
    }
}

impl std::error::Error for StartError {}

/// The whole service.
pub struct Service {
    /// Ready for requests.
    pub router: Router,
    /// Answers when all connections are taken.
    probes: Router,
    pub(crate) state: Shared,
    gate: Gate,
}

impl Service {
    /// Opens what the settings name.
    pub async fn open(config: &ServeConfig) -> Result<Self, StartError> {
        let mut machines = MachineRegistry::default();
        if let Some(directory) = &config.machines {
            machines.publish_directory(directory).map_err(StartError::Machine)?;
        }
        let admission = Admission::new(config.max_requests, config.max_body_bytes);
        let gate = Gate::open(
            config.keys.clone(),
            Rate::new(config.rate, config.rate_burst),
            Pages::new(&config.allowed_host, &config.cors_origin, config.listen.is_loopback()),
            Arc::clone(&admission),
        )
        .await
        .map_err(StartError::Keys)?;
        let (routes, _) = router::routes(&gate).split_for_parts();
        let Storage { results, jobs, runs, computations } =
            Storage::open(config).await.map_err(StartError::Storage)?;
        let stopping = CancellationToken::new();
        let readiness = Readiness::new(results.clone(), Arc::clone(&jobs), stopping.clone());
        let mut metrics = Metrics::of(Arc::clone(&jobs), results.store(), &computations);
        metrics.tell_of_admission(Arc::clone(&admission));
        if let Some(runs) = runs {
            metrics.tell_of_seats(move || runs.slots());
        }
        let (requests, base) = (Arc::clone(&metrics.requests), &config.base_path);
        let limits = config.limits();
        let costs = Cache::new(ESTIMATES);
        let state = Arc::new(State {
            machines,
            limits,
            admission,
            results,
            jobs,
            costs,
            readiness,
            metrics,
            base: base.clone(),
            document: service::document(base),
            stopping,
        });
        let document = format!("{base}/openapi.json");
        let docs = SwaggerUi::new("/docs").config(Config::new([document]).validator_url("none"));
        let docs = security_headers::pages(docs.into(), security_headers::DOCS);
        let pages = gate.before_pages(base_path::with_page(docs.merge(viewer::routes()), base));
        let routes = routes.with_state(Arc::clone(&state)).merge(pages);
        let browsers = Browsers::new(&config.cors_origin, config.tls_certificate.is_some());
        let wrapped = |routes| {
            let (requests, proxies) = (Arc::clone(&requests), config.trusted_proxy.clone());
            let wrapped =
                middleware::wrap(routes, requests, Duration::from_secs(config.timeout), &browsers, proxies);
            base_path::under(wrapped, base)
        };
        let probes = wrapped(router::probes(&gate).with_state(Arc::clone(&state)));
        Ok(Self { router: wrapped(routes), probes, state, gate })
    }

    /// Reads the keys again, as at SIGHUP; if the file cannot be used, they stay as they are.
    pub async fn reload_keys(&self) -> Result<(), StartError> {
        self.gate.reload().await.map_err(StartError::Keys)
    }

    /// Stops: whoever waits for a job is told so, and jobs go back to the queue. Returns within about `limit`.
    pub async fn stop(&self, limit: Duration) {
        self.state.stopping.cancel();
        self.state.jobs.drain(limit).await;
    }
}

/// Serves until SIGTERM or ctrl-c.
pub(crate) async fn serve(config: &ServeConfig) -> Result<(), StartError> {
    let listeners = config.listen.bind().await;
    let listeners = listeners.map_err(|error| StartError::Listen(config.listen, error))?;
    serve_on(listeners, config, told_to_stop()).await
}

/// Serves on one or two listeners until `told` is over, which may be before the service is open. Then requests under
/// way are finished and jobs go back to the queue, all within a bounded time.
pub async fn serve_on(
    listeners: Vec<TcpListener>,
    config: &ServeConfig,
    told: impl Future<Output = ()>,
) -> Result<(), StartError> {
    let mut told = pin!(told);
    let hangups = pin!(outlive_hangups(config.keys.is_some()));
    leave_one_core_free();
    let server = Server::new(listeners, &Terms::from(config)).map_err(StartError::Tls)?;
    let service = tokio::select! {
        service = Service::open(config) => service?,
        // The broker may be waited for.
        () = &mut told => return Ok(()),
    };
    server.announce(config.keys.is_some()).map_err(|error| StartError::Listen(config.listen, error))?;
    let limit = Duration::from_secs(config.drain);
    let stopped = async {
        tokio::select! {
            () = told => {}
            () = hangups => {}
        }
        service.stop(limit).await;
    };
    let (router, probes) = (service.router.clone(), service.probes.clone());
    let connections = service.state.metrics.connections.clone();
    tokio::join!(stopped, server.serve(router, probes, connections, &service.state.stopping, limit));
    Ok(())
}
