//! Shutdown with jobs, and their continuation in the next process.

use axum::http::StatusCode;
use axum::http::header::RETRY_AFTER;
use serde_json::Value;
use tempfile::TempDir;

use super::get_from;
use super::jobs::{cancel, events, job, listed, long, small, start, table, until};
use super::restart::{close, open};
use super::workspace::ask;

fn is_live(job: &Value) -> bool {
    ["queued", "running"].contains(&job["state"].as_str().unwrap())
}

#[tokio::test]
async fn shutdown_answers_waiting_clients() {
    let place = TempDir::new().unwrap();
    let service = open(place.path()).await;
    assert_eq!(get_from(&service.router, "/readyz", &[]).await.status, StatusCode::OK);
    let id = start(&service.router, &long(0)).await;
    let asking = service.router.clone();
    let client = tokio::spawn(async move { ask(&asking, long(0)).await });
    let (watching, watched) = (service.router.clone(), id.clone());
    let watcher = tokio::spawn(async move { events(&watching, &watched).await });
    until(&service.router, &id, |job| job["progress"].as_f64() > Some(0.0)).await;

    let router = service.router.clone();
    close(service).await;
    let told = client.await.unwrap();
    told.assert_problem(503, "stopping");
    assert!(told.headers.contains_key(RETRY_AFTER));
    assert!(watcher.await.unwrap().iter().all(is_live), "the stream ends before the job does");
    let unready = get_from(&router, "/readyz", &[]).await;
    unready.assert_problem(503, "stopping");
    assert!(unready.headers.contains_key(RETRY_AFTER));
    ask(&router, small(1)).await.assert_problem(503, "stopping");
    assert_eq!(get_from(&router, "/livez", &[]).await.status, StatusCode::OK);
}

#[tokio::test]
async fn jobs_continue_after_a_restart() {
    let place = TempDir::new().unwrap();
    let service = open(place.path()).await;
    let running = start(&service.router, &long(0)).await;
    until(&service.router, &running, |job| job["progress"].as_f64() > Some(0.0)).await;
    let queued = start(&service.router, &table()).await;
    let created = job(&service.router, &queued).await["created"].clone();
    close(service).await;

    let service = open(place.path()).await;
    for id in [&running, &queued] {
        assert!(is_live(&job(&service.router, id).await));
    }
    cancel(&service.router, &running).await;
    let last = events(&service.router, &queued).await.pop().unwrap();
    assert_eq!((&last["state"], &last["created"]), (&"succeeded".into(), &created));
    let undisturbed = ask(&super::service().await, table()).await;
    assert_eq!(
        get_from(&service.router, last["result"].as_str().unwrap(), &[]).await.bytes,
        undisturbed.bytes
    );
}

/// The answer promises it: what was asked for goes on when the service is started again.
#[tokio::test]
async fn jobs_of_waiting_clients_continue_after_a_restart() {
    let place = TempDir::new().unwrap();
    let service = open(place.path()).await;
    let waiting = |question: Value| {
        let router = service.router.clone();
        tokio::spawn(async move { ask(&router, question).await })
    };
    let clients = [waiting(long(0)), waiting(long(100))];
    let ids = [listed(&service.router, "running").await, listed(&service.router, "queued").await];
    close(service).await;
    for client in clients {
        client.await.unwrap().assert_problem(503, "stopping");
    }
    let service = open(place.path()).await;
    for id in ids {
        assert!(is_live(&job(&service.router, &id).await));
    }
}
