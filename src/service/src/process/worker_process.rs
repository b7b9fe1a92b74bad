//! `verne worker`: runs the jobs that wait at a broker, and puts their results where all reach them.

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
use verne_jobs::jetstream::{Worker, WorkerConfig as Threads};

use crate::http::error::HttpError;
use crate::http::handlers::service;
use crate::http::middleware;
use crate::http::readiness::Readiness;
use crate::http::security_headers::Browsers;
use crate::operations::job_executor::JobExecutor;
use crate::process::config::listen::Listen;
use crate::process::config::worker::WorkerConfig;
use crate::process::server::Server;
use crate::process::server::listener_config::Terms;
use crate::process::server::startup_warnings::warn_of_probes;
use crate::process::service::StartError;
use crate::process::signals::{outlive_hangups, told_to_stop};
use crate::process::storage;
use crate::process::storage::StorageError;
use crate::telemetry::metrics::Metrics;
use crate::telemetry::metrics::computations::Computations;

/// A worker submits parts of jobs only: the queue's bound is that of who submits jobs.
const QUEUE: usize = usize::MAX;

/// What the probes tell of.
struct Probed {
    readiness: Readiness,
    metrics: Metrics,
}

/// Runs jobs until SIGTERM or ctrl-c, which may come before it can. Then those under way go back to the queue, within a
/// bounded time.
pub(crate) async fn work(config: &WorkerConfig) -> Result<(), StartError> {
    let mut told = pin!(told_to_stop());
    let hangups = pin!(outlive_hangups(false));
    let opening = storage::shared::open(&config.broker, &config.store, config.cache_bytes, QUEUE);
    let (results, jobs) = tokio::select! {
        opened = opening => opened.map_err(StartError::Storage)?,
        () = &mut told => return Ok(()),
    };
    let computations = Computations::default();
    let tasks = Arc::new(JobExecutor::new(results.clone(), computations.clone(), Handle::current()));
    let (threads, slots) = config.threads_and_slots();
    let worker = Worker::start(&jobs, Threads { threads, slots }, tasks)
        .map_err(|error| StartError::Storage(StorageError::Broker(error)))?;
    tracing::info!(threads, slots, "accepting jobs");

    let stopping = CancellationToken::new();
    let mut metrics = Metrics::of(Arc::clone(&jobs) as Arc<dyn Backend>, results.store(), &computations);
    metrics.tell_of_worker(worker.occupancy());
    let readiness = Readiness::new(results, Arc::clone(&jobs) as Arc<dyn Backend>, stopping.clone());
    let probed = Arc::new(Probed { readiness, metrics });
    let limit = Duration::from_secs(config.drain);
    let serving = match config.listen {
        Some(address) => {
            let listener = TcpListener::bind(address).await;
            let listener = listener.map_err(|error| StartError::Listen(Listen::Address(address), error))?;
            tracing::info!("serving probes and metrics on http://{address}");
            warn_of_probes(address.ip());
            Some(serve(listener, &Terms::of_probes(), probed, stopping.clone(), limit)?)
        }
        None => None,
    };

    tokio::select! {
        () = told => {}
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

/// Answers probes until it is to stop, and what is asked then for as long as the limit.
fn serve(
    listener: TcpListener,
    terms: &Terms,
    probed: Arc<Probed>,
    stopping: CancellationToken,
    limit: Duration,
) -> Result<JoinHandle<()>, StartError> {
    let (requests, connections) = (Arc::clone(&probed.metrics.requests), probed.metrics.connections.clone());
    let routes = Router::new()
        .route("/livez", get(service::get_livez))
        .route(
            "/readyz",
            get(|State(probed): State<Arc<Probed>>| async move { probed.readiness.told().await }),
        )
        .route(
            "/metrics",
            get(|State(probed): State<Arc<Probed>>| async move {
                probed.metrics.answer().map_err(HttpError::from)
            }),
        )
        .fallback(service::nothing_here)
        .with_state(probed);
    let router = middleware::wrap(routes, requests, terms.stall, &Browsers::default(), Vec::new());
    let server = Server::new(vec![listener], terms).map_err(StartError::Tls)?;
    // Where there are only probes, those that come when all connections are taken are answered the same.
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

    use super::{Probed, serve, work};
    use crate::http::readiness::Readiness;
    use crate::process::config::ServeConfig;
    use crate::process::config::worker::WorkerConfig;
    use crate::process::server::listener_config::Terms;
    use crate::process::storage::Storage;
    use crate::telemetry::metrics::Metrics;

    async fn probed(stopping: CancellationToken) -> Arc<Probed> {
        let command = ServeConfig::augment_args(Command::new("verne").no_binary_name(true));
        let config = ServeConfig::from_arg_matches(&command.get_matches_from(["--memory-only"])).unwrap();
        let Storage { results, jobs, computations, .. } = Storage::open(&config).await.unwrap();
        let metrics = Metrics::of(Arc::clone(&jobs), results.store(), &computations);
        Arc::new(Probed { readiness: Readiness::new(results, jobs, stopping), metrics })
    }

    /// What comes after these bytes, until the connection is closed.
    async fn answer(listener: std::net::SocketAddr, bytes: &str) -> String {
        let mut stream = TcpStream::connect(listener).await.unwrap();
        stream.write_all(bytes.as_bytes()).await.unwrap();
        let mut answer = String::new();
        let reading = stream.read_to_string(&mut answer);
        tokio::time::timeout(Duration::from_mins(1), reading).await.unwrap().unwrap();
        answer
    }

    #[tokio::test]
    async fn probes_are_answered_within_bounds() {
        let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let address = listener.local_addr().unwrap();
        let stopping = CancellationToken::new();
        let terms = Terms { header: Duration::from_secs(1), connections: 1, ..Terms::of_probes() };
        let limit = Duration::from_mins(1);
        let serving =
            serve(listener, &terms, probed(stopping.clone()).await, stopping.clone(), limit).unwrap();

        let _taken = TcpStream::connect(address).await.unwrap();
        for (path, status) in [("livez", 200), ("readyz", 200), ("metrics", 200), ("fk", 404)] {
            let answer = answer(address, &format!("GET /{path} HTTP/1.1\r\nHost: verne\r\n\r\n")).await;
            assert!(answer.starts_with(&format!("HTTP/1.1 {status} ")), "{answer}");
        }
        assert_eq!(answer(address, "").await, "", "who says nothing is cut");
        assert_eq!(answer(address, "PRI * HTTP/2.0").await, "");
        stopping.cancel();
        tokio::time::timeout(Duration::from_mins(1), serving).await.unwrap().unwrap();
    }

    /// What `verne worker` ends with.
    async fn refusal(flags: &str) -> String {
        let command = WorkerConfig::augment_args(Command::new("verne").no_binary_name(true));
        let matches = command.get_matches_from(flags.split_whitespace());
        work(&WorkerConfig::from_arg_matches(&matches).unwrap()).await.unwrap_err().to_string()
    }

    /// A broker that knows nobody.
    #[tokio::test]
    async fn a_broker_that_refuses_is_not_waited_for() {
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
        let place = TempDir::new().unwrap();
        let store = format!("file://{}", place.path().display());
        Store::init_shared(&store).unwrap();
        let error = refusal(&format!("--broker nats://verne:wrong@{address} --store {store}")).await;
        assert!(error.starts_with("broker: ") && error.contains("refuses this process"), "{error}");
        assert!(!error.contains("wrong"), "{error}");
    }

    #[tokio::test]
    async fn what_is_missing_is_named() {
        for (flags, expected) in [
            ("", "broker: "),
            ("--store file:///nowhere", "broker: "),
            ("--broker nats://127.0.0.1:1", "store: "),
            ("--broker http://127.0.0.1:1 --store file:///proc/nowhere", "broker: "),
        ] {
            let error = refusal(flags).await;
            assert!(error.starts_with(expected), "{flags}: {error}");
        }
    }
}
