//! Puts the service together, and runs it until it is told to stop.

use std::fmt;
use std::sync::{Arc, OnceLock};
use std::time::Duration;

use axum::Router;
use axum::body::Bytes;
use serde_json::Value;
use tokio::net::TcpListener;
use utoipa_swagger_ui::{Config, SwaggerUi};

use crate::config::ServeConfig;
use crate::registry::{BadFile, Registry};
use crate::results::Results;
use crate::state::State;
use crate::{layers, openapi, router, viewer};

/// Why the service cannot run.
#[derive(Debug)]
pub enum StartError {
    /// A machine's file.
    Machine(BadFile),
    /// The address, or the listener later on.
    Listen(std::net::SocketAddr, std::io::Error),
}

impl fmt::Display for StartError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Machine(bad) => bad.fmt(f),
            Self::Listen(address, error) => write!(f, "cannot serve on {address}: {error}"),
        }
    }
}

impl std::error::Error for StartError {}

/// The OpenAPI document.
pub fn document() -> Value {
    openapi::complete(router::routes().get_openapi())
}

/// The document as it is sent. It is the same for every service: its examples are computed once.
static DOCUMENT: OnceLock<Bytes> = OnceLock::new();

/// The whole service, ready for requests.
pub fn service(config: &ServeConfig) -> Result<Router, StartError> {
    let mut machines = Registry::default();
    if let Some(directory) = &config.machines {
        machines.publish_directory(directory).map_err(StartError::Machine)?;
    }
    let (routes, api) = router::routes().split_for_parts();
    let document = DOCUMENT.get_or_init(|| Bytes::from(openapi::complete(&api).to_string())).clone();
    let results = Results::within(config.cache_bytes);
    let state = State { machines, limits: config.limits(), results, openapi: document };
    let docs = SwaggerUi::new("/docs").config(Config::new(["/openapi.json"]).validator_url("none"));
    let routes = routes.with_state(Arc::new(state)).merge(docs).merge(viewer::routes());
    Ok(layers::wrap(routes, Duration::from_secs(config.timeout)))
}

/// Serves until SIGTERM or ctrl-c; requests under way are finished.
pub async fn serve(config: &ServeConfig) -> Result<(), StartError> {
    let failed = |error| StartError::Listen(config.listen, error);
    let service = service(config)?;
    let listener = TcpListener::bind(config.listen).await.map_err(failed)?;
    tracing::info!("listening on http://{}", listener.local_addr().map_err(failed)?);
    axum::serve(listener, service).with_graceful_shutdown(told_to_stop()).await.map_err(failed)
}

async fn told_to_stop() {
    let interrupted = async {
        // Without a handler the default remains: the signal ends the process.
        if tokio::signal::ctrl_c().await.is_err() {
            std::future::pending::<()>().await;
        }
    };
    tokio::select! {
        () = interrupted => {}
        () = terminated() => {}
    }
    tracing::info!("stopping: requests under way are finished");
}

#[cfg(unix)]
async fn terminated() {
    use tokio::signal::unix::{SignalKind, signal};
    match signal(SignalKind::terminate()) {
        Ok(mut signals) => drop(signals.recv().await),
        Err(_) => std::future::pending().await,
    }
}

#[cfg(not(unix))]
async fn terminated() {
    std::future::pending().await
}
