//! Cancellation of jobs, by request and by disconnection.

use axum::Router;
use axum::http::StatusCode;
use serde_json::{Value, json};
use tokio::task::JoinHandle;

use super::jobs::{cancel, events, job, listed, long, metric, one_core, small, start, table, until};
use super::workspace::ask;
use super::{Reply, opened, service};

/// A client that waits for its answer.
fn waiting(service: &Router, question: Value) -> JoinHandle<Reply> {
    let service = service.clone();
    tokio::spawn(async move { ask(&service, question).await })
}

async fn end(service: &Router, id: &str) -> Value {
    events(service, id).await.pop().unwrap()["state"].clone()
}

#[tokio::test]
async fn a_job_is_cancelled_when_its_last_client_disconnects() {
    let service = opened(&one_core()).await;
    let client = waiting(&service, long(0));
    let id = listed(&service, "running").await;
    until(&service, &id, |job| job["progress"].as_f64() > Some(0.0)).await;
    client.abort();
    assert_eq!(end(&service, &id).await, "cancelled");
}

#[tokio::test]
async fn a_job_continues_while_another_client_waits() {
    let service = opened(&one_core()).await;
    let before = start(&service, &long(0)).await;
    let leaving = waiting(&service, table());
    let id = listed(&service, "queued").await;
    let created = job(&service, &id).await["created"].clone();
    let staying = waiting(&service, table());
    for _ in 0..10 {
        job(&service, &id).await;
    }
    leaving.abort();
    assert!(leaving.await.unwrap_err().is_cancelled());
    assert_eq!(job(&service, &id).await["state"], "queued");
    cancel(&service, &before).await;
    assert_eq!(staying.await.unwrap().status, StatusCode::OK);
    assert_eq!(job(&service, &id).await["created"], created, "it is the one that both waited for");
}

#[tokio::test]
async fn a_job_continues_after_a_202() {
    let service = opened(&one_core()).await;
    let before = start(&service, &long(0)).await;
    let client = waiting(&service, table());
    let id = listed(&service, "queued").await;
    assert_eq!(start(&service, &table()).await, id);
    client.abort();
    assert!(client.await.unwrap_err().is_cancelled());
    assert_eq!(job(&service, &id).await["state"], "queued");
    cancel(&service, &before).await;
    assert_eq!(end(&service, &id).await, "succeeded");
}

#[tokio::test]
async fn delete_cancels_a_running_job() {
    let service = opened(&one_core()).await;
    let client = waiting(&service, long(0));
    let id = listed(&service, "running").await;
    let created = until(&service, &id, |job| job["progress"].as_f64() > Some(0.0)).await["created"].clone();
    let reply = cancel(&service, &id).await;
    assert_eq!((reply.status, &reply.json["id"]), (StatusCode::OK, &json!(id)));
    client.await.unwrap().assert_problem(409, "job_cancelled");
    let ended = job(&service, &id).await;
    assert_eq!(
        (&ended["state"], &ended["result"], &ended["error"]),
        (&json!("cancelled"), &Value::Null, &Value::Null)
    );
    assert!(ended["finished"].is_string());
    assert_eq!(ended["created"], created);
    // Its parts end as soon as they look.
    while metric(&service, "verne_jobs_running").await > 0 {
        tokio::task::yield_now().await;
    }

    let started = metric(&service, "verne_jobs_started_total").await;
    assert_eq!(start(&service, &long(0)).await, id, "asked again, it starts anew");
    until(&service, &id, |job| job["progress"].as_f64() > Some(0.0)).await;
    assert!(metric(&service, "verne_jobs_started_total").await > started);
}

#[tokio::test]
async fn delete_cancels_a_queued_job() {
    let service = opened(&one_core()).await;
    let before = start(&service, &long(0)).await;
    let client = waiting(&service, long(100));
    let id = listed(&service, "queued").await;
    let reply = cancel(&service, &id).await.json;
    assert_eq!((&reply["state"], &reply["started"]), (&json!("cancelled"), &Value::Null));
    client.await.unwrap().assert_problem(409, "job_cancelled");
    assert_eq!(job(&service, &before).await["state"], "running");
    assert_eq!(start(&service, &long(100)).await, id);
    assert_eq!(job(&service, &id).await["state"], "queued");
}

#[tokio::test]
async fn delete_does_not_change_a_finished_job() {
    let service = service().await;
    let id = ask(&service, small(50)).await.json["id"].as_str().unwrap().to_owned();
    let finished = events(&service, &id).await.pop().unwrap();
    assert_eq!(finished["state"], "succeeded");
    assert_eq!(cancel(&service, &id).await.json, finished);
    assert_eq!(job(&service, &id).await, finished);
    assert_eq!(ask(&service, small(50)).await.status, StatusCode::OK);
}
