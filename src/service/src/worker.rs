//! `verne worker`: runs the jobs that wait at a broker, and puts their results where all reach them.

use std::net::SocketAddr;
use std::sync::Arc;
use std::time::Duration;

use axum::Router;
use axum::extract::State;
use axum::routing::get;
use tokio::net::TcpListener;
use tokio::runtime::Handle;
use tokio_util::sync::CancellationToken;
use verne_jobs::Backend;
use verne_jobs::jetstream::{Worker, WorkerConfig as Threads};

use crate::app::{StartError, told_to_stop};
use crate::config::worker::WorkerConfig;
use crate::handlers::service;
use crate::metrics::{Computations, Metrics};
use crate::readiness::Readiness;
use crate::storage::{self, StorageError};
use crate::tasks::Tasks;

/// A worker submits parts of jobs only: the queue's bound is that of who submits jobs.
const QUEUE: usize = usize::MAX;

/// What the probes tell of.
struct Probed {
    readiness: Readiness,
    metrics: Metrics,
}

/// Runs jobs until SIGTERM or ctrl-c. Then those under way go back to the queue, within a bounded time.
pub(crate) async fn work(config: &WorkerConfig) -> Result<(), StartError> {
    let results =
        storage::open_store(&config.store, config.cache_bytes).await.map_err(StartError::Storage)?;
    let jobs = storage::connect(&config.broker, QUEUE).await.map_err(StartError::Storage)?;
    let computations = Computations::default();
    let tasks = Arc::new(Tasks::new(results.clone(), computations.clone(), Handle::current()));
    let (threads, slots) = config.threads_and_slots();
    let worker = Worker::start(&jobs, Threads { threads, slots }, tasks)
        .map_err(|error| StartError::Storage(StorageError::Broker(error)))?;
    tracing::info!(threads, slots, "jobs are taken");

    let stopping = CancellationToken::new();
    let mut metrics = Metrics::of(Arc::clone(&jobs) as Arc<dyn Backend>, results.store(), &computations);
    metrics.tell_of_worker(worker.occupancy());
    let readiness = Readiness::new(results, Arc::clone(&jobs) as Arc<dyn Backend>, stopping.clone());
    let probed = Arc::new(Probed { readiness, metrics });
    let serving = match config.listen {
        Some(address) => Some(serve(address, probed, stopping.clone()).await?),
        None => None,
    };

    told_to_stop().await;
    stopping.cancel();
    let limit = Duration::from_secs(config.drain);
    worker.drain(limit).await;
    jobs.drain(limit).await;
    if let Some(serving) = serving {
        serving.abort();
    }
    Ok(())
}

async fn serve(
    address: SocketAddr,
    probed: Arc<Probed>,
    stopping: CancellationToken,
) -> Result<tokio::task::JoinHandle<()>, StartError> {
    let failed = |error| StartError::Listen(address, error);
    let listener = TcpListener::bind(address).await.map_err(failed)?;
    tracing::info!("probes and metrics on http://{}", listener.local_addr().map_err(failed)?);
    let router = Router::new()
        .route("/livez", get(service::get_livez))
        .route(
            "/readyz",
            get(|State(probed): State<Arc<Probed>>| async move { probed.readiness.told().await }),
        )
        .route("/metrics", get(|State(probed): State<Arc<Probed>>| async move { probed.metrics.answer() }))
        .fallback(service::nothing_here)
        .with_state(probed);
    let served = axum::serve(listener, router).with_graceful_shutdown(stopping.cancelled_owned());
    Ok(tokio::spawn(async move {
        if let Err(error) = served.await {
            tracing::error!(%error, "probes are not answered any more");
        }
    }))
}
