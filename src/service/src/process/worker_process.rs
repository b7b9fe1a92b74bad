//! `verne worker`: runs jobs from the broker and writes their results to the shared store.

use std::pin::pin;
use std::sync::Arc;
use std::time::Duration;

use axum::Router;
use axum::extract::State;
use axum::routing::get;
use tokio::net::TcpListener;
use tokio::runtime::Handle;
use tokio::task::JoinHandle;
use tokio_util::sync::CancellationToken;
use verne_jobs::Backend;
use verne_jobs::jetstream::{self, Worker};

use crate::http::error::HttpError;
use crate::http::handlers::service;
use crate::http::middleware;
use crate::http::readiness::Readiness;
use crate::http::security_headers::BrowserPolicy;
use crate::operations::job_executor::JobExecutor;
use crate::process::config::listen::Listen;
use crate::process::config::worker::WorkerConfig;
use crate::process::server::Server;
use crate::process::server::listener_config::ListenerConfig;
use crate::process::server::startup_warnings::warn_if_probes_are_open;
use crate::process::signals::{handle_hangups, stop_signal};
use crate::process::start_error::StartError;
use crate::process::storage;
use crate::process::storage::error::StorageError;
use crate::telemetry::metrics::Metrics;
use crate::telemetry::metrics::computations::ComputationMetrics;

/// A worker submits only subtasks. The process that submits a job limits the queue.
const QUEUE: usize = usize::MAX;

/// The state of the probes.
struct ProbeState {
    readiness: Readiness,
    metrics: Metrics,
}

/// Runs jobs until SIGTERM or ctrl-c, which may arrive before the worker is connected. Then it returns its jobs to the
/// queue, within the time `drain` of the settings.
pub(crate) async fn run(config: &WorkerConfig) -> Result<(), StartError> {
    let mut stop = pin!(stop_signal());
    let hangups = pin!(handle_hangups(false));
    let opening = storage::shared::open(&config.broker, &config.store, config.cache_bytes, QUEUE);
    let (results, jobs) = tokio::select! {
        opened = opening => opened.map_err(StartError::Storage)?,
        () = &mut stop => return Ok(()),
    };
    let computations = ComputationMetrics::default();
    let tasks = Arc::new(JobExecutor::new(results.clone(), computations.clone(), Handle::current()));
    let (threads, slots) = config.threads_and_slots();
    let worker = Worker::start(&jobs, jetstream::WorkerConfig { threads, slots }, tasks)
        .map_err(|error| StartError::Storage(StorageError::Broker(error)))?;
    tracing::info!(threads, slots, "accepting jobs");

    let stopping = CancellationToken::new();
    let mut metrics = Metrics::new(Arc::clone(&jobs) as Arc<dyn Backend>, results.store(), &computations);
    metrics.register_worker(worker.occupancy());
    let readiness = Readiness::new(results, Arc::clone(&jobs) as Arc<dyn Backend>, stopping.clone());
    let probes = Arc::new(ProbeState { readiness, metrics });
    let limit = Duration::from_secs(config.drain);
    let serving = match config.listen {
        Some(address) => {
            let listener = TcpListener::bind(address).await;
            let listener = listener.map_err(|error| StartError::Listen(Listen::Address(address), error))?;
            tracing::info!("serving probes and metrics on http://{address}");
            warn_if_probes_are_open(address.ip());
            Some(serve(listener, &ListenerConfig::for_probes(), probes, stopping.clone(), limit)?)
        }
        None => None,
    };

    tokio::select! {
        () = stop => {}
        () = hangups => {}
    }
    stopping.cancel();
    worker.drain(limit).await;
    jobs.drain(limit).await;
    if let Some(serving) = serving {
        drop(serving.await);
    }
    Ok(())
}

/// Answers probes until `stopping` is cancelled, and finishes the requests in progress within `limit`.
fn serve(
    listener: TcpListener,
    config: &ListenerConfig,
    probes: Arc<ProbeState>,
    stopping: CancellationToken,
    limit: Duration,
) -> Result<JoinHandle<()>, StartError> {
    let (requests, connections) = (Arc::clone(&probes.metrics.requests), probes.metrics.connections.clone());
    let routes = Router::new()
        .route("/livez", get(service::get_livez))
        .route(
            "/readyz",
            get(|State(probes): State<Arc<ProbeState>>| async move { probes.readiness.check().await }),
        )
        .route(
            "/metrics",
            get(|State(probes): State<Arc<ProbeState>>| async move {
                probes.metrics.answer().map_err(HttpError::from)
            }),
        )
        .fallback(service::unknown_path)
        .with_state(probes);
    let router =
        middleware::wrap(routes, requests, config.timeouts.stall, &BrowserPolicy::default(), Vec::new());
    let server = Server::new(vec![listener], config).map_err(StartError::Tls)?;
    // All routes are probes, so connections beyond the limit may use all of them.
    Ok(tokio::spawn(async move {
        server.serve(router.clone(), router, connections, &stopping, limit).await;
    }))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use std::sync::Arc;
    use std::time::Duration;

    use clap::{Args, Command, FromArgMatches};
    use tempfile::TempDir;
    use tokio::io::{AsyncReadExt, AsyncWriteExt};
    use tokio::net::{TcpListener, TcpStream};
    use tokio_util::sync::CancellationToken;
    use verne_store::Store;

    use super::{ProbeState, run, serve};
    use crate::http::readiness::Readiness;
    use crate::process::config::worker::WorkerConfig;
    use crate::process::server::listener_config::{ListenerConfig, Timeouts};
    use crate::process::storage::Storage;
    use crate::telemetry::metrics::Metrics;
    use crate::test_service::settings;

    async fn probe_state(stopping: CancellationToken) -> Arc<ProbeState> {
        let Storage { results, jobs, computations, .. } = Storage::open(&settings("")).await.unwrap();
        let metrics = Metrics::new(Arc::clone(&jobs), results.store(), &computations);
        Arc::new(ProbeState { readiness: Readiness::new(results, jobs, stopping), metrics })
    }

    /// Everything that the listener answers to these bytes until it closes the connection.
    async fn answer(listener: std::net::SocketAddr, bytes: &str) -> String {
        let mut stream = TcpStream::connect(listener).await.unwrap();
        stream.write_all(bytes.as_bytes()).await.unwrap();
        let mut answer = String::new();
        let reading = stream.read_to_string(&mut answer);
        tokio::time::timeout(Duration::from_mins(1), reading).await.unwrap().unwrap();
        answer
    }

    #[tokio::test]
    async fn probes_are_answered_and_silent_connections_are_closed() {
        let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let address = listener.local_addr().unwrap();
        let stopping = CancellationToken::new();
        let timeouts = Timeouts { header: Duration::from_secs(1), stall: Duration::from_secs(30) };
        let config = ListenerConfig { timeouts, connections: 1, ..ListenerConfig::for_probes() };
        let limit = Duration::from_mins(1);
        let serving =
            serve(listener, &config, probe_state(stopping.clone()).await, stopping.clone(), limit).unwrap();

        let _taken = TcpStream::connect(address).await.unwrap();
        for (path, status) in [("livez", 200), ("readyz", 200), ("metrics", 200), ("fk", 404)] {
            let answer = answer(address, &format!("GET /{path} HTTP/1.1\r\nHost: verne\r\n\r\n")).await;
            assert!(answer.starts_with(&format!("HTTP/1.1 {status} ")), "{answer}");
        }
        assert_eq!(answer(address, "").await, "");
        assert_eq!(answer(address, "PRI * HTTP/2.0").await, "");
        stopping.cancel();
        tokio::time::timeout(Duration::from_mins(1), serving).await.unwrap().unwrap();
    }

    /// The error of `verne worker`.
    async fn start_error(flags: &str) -> String {
        let command = WorkerConfig::augment_args(Command::new("verne").no_binary_name(true));
        let matches = command.get_matches_from(flags.split_whitespace());
        run(&WorkerConfig::from_arg_matches(&matches).unwrap()).await.unwrap_err().to_string()
    }

    /// The broker rejects every user.
    #[tokio::test]
    async fn a_worker_ends_if_the_broker_rejects_it() {
        let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let address = listener.local_addr().unwrap();
        tokio::spawn(async move {
            loop {
                let (mut stream, _) = listener.accept().await.unwrap();
                let info =
                    r#"INFO {"server_id":"a","version":"2.11.0","auth_required":true,"max_payload":1048576}"#;
                stream.write_all(format!("{info}\r\n").as_bytes()).await.unwrap();
                assert!(stream.read(&mut [0; 4096]).await.unwrap() > 0);
                stream.write_all(b"-ERR 'Authorization Violation'\r\n").await.unwrap();
            }
        });
        let directory = TempDir::new().unwrap();
        let store = format!("file://{}", directory.path().display());
        Store::init_shared(&store).unwrap();
        let error = start_error(&format!("--broker nats://verne:wrong@{address} --store {store}")).await;
        assert!(error.starts_with("broker: ") && error.contains("refuses this process"), "{error}");
        assert!(!error.contains("wrong"), "{error}");
    }

    #[tokio::test]
    async fn errors_name_the_missing_setting() {
        for (flags, expected) in [
            ("", "broker: "),
            ("--store file:///nowhere", "broker: "),
            ("--broker nats://127.0.0.1:1", "store: "),
            ("--broker http://127.0.0.1:1 --store file:///proc/nowhere", "broker: "),
        ] {
            let error = start_error(flags).await;
            assert!(error.starts_with(expected), "{flags}: {error}");
        }
    }
}
