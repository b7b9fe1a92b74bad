//! `verne serve`: assembles the service from the settings, and serves until a stop signal.

use std::pin::pin;
use std::sync::Arc;
use std::time::Duration;

use axum::Router;
use moka::future::Cache;
use tokio::net::TcpListener;
use tokio_util::sync::CancellationToken;
use utoipa_swagger_ui::{Config, SwaggerUi};

use crate::http::access_control::AccessControl;
use crate::http::allowed_origins::AllowedOrigins;
use crate::http::openapi::versions::Documents;
use crate::http::readiness::Readiness;
use crate::http::security_headers::BrowserPolicy;
use crate::http::state::{AppState, ESTIMATES, SharedState};
use crate::http::{base_path, guide_files, middleware, router, security_headers, viewer_files};
use crate::limits::admission::Admission;
use crate::limits::rate::Rate;
use crate::operations::compute_pool::leave_one_core_free;
use crate::operations::machine_registry::MachineRegistry;
use crate::process::config::ServeConfig;
use crate::process::server::Server;
use crate::process::server::listener_config::ListenerConfig;
use crate::process::signals::{handle_hangups, stop_signal};
use crate::process::start_error::StartError;
use crate::process::storage::Storage;
use crate::telemetry::metrics::Metrics;

/// The service without its listener.
pub struct Service {
    /// All routes.
    pub router: Router,
    /// The routes that also connections beyond the limit may use.
    probes: Router,
    pub(crate) state: SharedState,
    access_control: AccessControl,
}

impl Service {
    /// Opens the machines, the keys, the result store and the job queue that the settings name.
    pub async fn open(config: &ServeConfig) -> Result<Self, StartError> {
        let mut machines = MachineRegistry::default();
        if let Some(directory) = &config.machines {
            machines.publish_directory(directory).map_err(StartError::Machine)?;
        }
        let admission = Admission::new(config.max_requests, config.max_body_bytes);
        let access_control = open_access_control(config, &admission).await?;
        let storage = Storage::open(config).await.map_err(StartError::Storage)?;
        let state = Arc::new(state(config, machines, admission, storage));
        let (routes, _) = router::routes(&access_control).split_for_parts();
        let routes = routes.with_state(Arc::clone(&state)).merge(pages(&access_control, config));
        let probes = router::probes(&access_control).with_state(Arc::clone(&state));
        let [router, probes] = [routes, probes].map(|routes| with_middleware(routes, config, &state));
        Ok(Self { router, probes, state, access_control })
    }

    /// Reloads the keys, as at SIGHUP. If the file cannot be used, the previous keys stay in use.
    pub async fn reload_keys(&self) -> Result<(), StartError> {
        self.access_control.reload().await.map_err(StartError::Keys)
    }

    /// Ends the requests that wait for a job, and returns the jobs to the queue. Takes about `limit` at most.
    pub async fn stop(&self, limit: Duration) {
        self.state.stopping.cancel();
        self.state.jobs.drain(limit).await;
    }
}

async fn open_access_control(
    config: &ServeConfig,
    admission: &Arc<Admission>,
) -> Result<AccessControl, StartError> {
    let rate = Rate::new(config.rate, config.rate_burst);
    let pages = AllowedOrigins::new(&config.allowed_host, &config.cors_origin, config.listen.is_loopback());
    let access_control = AccessControl::open(config.keys.clone(), rate, pages, Arc::clone(admission));
    access_control.await.map_err(StartError::Keys)
}

fn state(
    config: &ServeConfig,
    machines: MachineRegistry,
    admission: Arc<Admission>,
    storage: Storage,
) -> AppState {
    let Storage { results, jobs, embedded, computations } = storage;
    let stopping = CancellationToken::new();
    let mut metrics = Metrics::new(Arc::clone(&jobs), results.store(), &computations);
    metrics.register_limits(Arc::clone(&admission));
    if let Some(embedded) = embedded {
        metrics.register_slots(move || embedded.slots());
    }
    AppState {
        machines,
        limits: config.limits(),
        admission,
        readiness: Readiness::new(results.clone(), Arc::clone(&jobs), stopping.clone()),
        results,
        jobs,
        costs: Cache::new(ESTIMATES),
        metrics,
        base: config.base_path.clone(),
        documents: Documents::new(&config.base_path),
        stopping,
    }
}

/// The pages for browsers: the API documentation, the guide and the viewer.
fn pages(access_control: &AccessControl, config: &ServeConfig) -> Router {
    let document = format!("{}/openapi.json", config.base_path);
    let docs = SwaggerUi::new("/docs").config(Config::new([document]).validator_url("none"));
    let docs = security_headers::pages(docs.into(), security_headers::DOCS);
    let pages = docs.merge(guide_files::routes()).merge(viewer_files::routes());
    access_control.guard_pages(base_path::with_redirect(pages, &config.base_path))
}

fn with_middleware(routes: Router, config: &ServeConfig, state: &AppState) -> Router {
    let browsers = BrowserPolicy::new(&config.cors_origin, config.tls_certificate.is_some());
    let requests = Arc::clone(&state.metrics.requests);
    let (timeout, proxies) = (Duration::from_secs(config.timeout), config.trusted_proxy.clone());
    base_path::nest(middleware::wrap(routes, requests, timeout, &browsers, proxies), &config.base_path)
}

/// Serves until SIGTERM or ctrl-c.
pub(crate) async fn serve(config: &ServeConfig) -> Result<(), StartError> {
    let listeners = config.listen.bind().await;
    let listeners = listeners.map_err(|error| StartError::Listen(config.listen, error))?;
    serve_on(listeners, config, stop_signal()).await
}

/// Serves on one or two listeners until `stop` is ready, which may be before the service is open. Then it finishes the
/// requests in progress and returns the jobs to the queue, within the time `drain` of the settings.
pub async fn serve_on(
    listeners: Vec<TcpListener>,
    config: &ServeConfig,
    stop: impl Future<Output = ()>,
) -> Result<(), StartError> {
    let mut stop = pin!(stop);
    let hangups = pin!(handle_hangups(config.keys.is_some()));
    leave_one_core_free();
    let server = Server::new(listeners, &ListenerConfig::from(config)).map_err(StartError::Tls)?;
    let service = tokio::select! {
        service = Service::open(config) => service?,
        // Opening may wait for the broker.
        () = &mut stop => return Ok(()),
    };
    let listen_error = |error| StartError::Listen(config.listen, error);
    server.log_addresses(config.keys.is_some()).map_err(listen_error)?;
    let drain = Duration::from_secs(config.drain);
    let stopped = async {
        tokio::select! {
            () = stop => {}
            () = hangups => {}
        }
        service.stop(drain).await;
    };
    let (router, probes) = (service.router.clone(), service.probes.clone());
    let connections = service.state.metrics.connections.clone();
    tokio::join!(stopped, server.serve(router, probes, connections, &service.state.stopping, drain));
    Ok(())
}
