//! Refused jobs, the time limit of jobs, and unusable data directories.

use axum::http::header::RETRY_AFTER;
use serde_json::json;
use tempfile::TempDir;
use verne_service::{ServeConfig, Service};

use super::jobs::{events, job, long, one_core, preferring, start, until};
use super::workspace::ask;
use super::{config, opened, send_to};

#[tokio::test]
async fn a_full_queue_answers_with_retry_after() {
    let service = opened(&ServeConfig { queue: 1, ..one_core() }).await;
    let running = start(&service, &long(0)).await;
    // Now its parts are in the queue.
    until(&service, &running, |job| job["progress"].as_f64() > Some(0.0)).await;
    let refused = send_to(service.clone(), preferring("respond-async", &long(200))).await;
    refused.assert_problem(503, "queue_full");
    let pause: u64 = refused.headers[RETRY_AFTER].to_str().unwrap().parse().unwrap();
    assert!((1..=60).contains(&pause), "{pause}");
    assert_eq!(start(&service, &long(0)).await, running, "who asks for what is there takes no place");
}

#[tokio::test]
async fn a_job_that_exceeds_the_time_limit_fails() {
    let service = opened(&ServeConfig { job_limit: 0, ..one_core() }).await;
    ask(&service, long(0)).await.assert_problem(503, "job_too_long");
    let accepted = send_to(service.clone(), preferring("respond-async", &long(100))).await.json;
    let id = accepted["id"].as_str().unwrap();
    let last = events(&service, id).await.pop().unwrap();
    assert_eq!(last["state"], "failed");
    assert_eq!((&last["error"]["code"], &last["error"]["status"]), (&json!("job_too_long"), &json!(503)));
    assert_eq!(job(&service, id).await, last);
}

async fn refusal(config: &ServeConfig) -> String {
    Service::open(config).await.err().unwrap().to_string()
}

#[tokio::test]
async fn an_unusable_data_directory_is_named() {
    let place = TempDir::new().unwrap();
    let file = place.path().join("file");
    std::fs::write(&file, "not a directory").unwrap();
    let config = ServeConfig { data: Some(file.clone()), memory_only: false, ..config(None) };
    let refusal = refusal(&config).await;
    assert!(refusal.contains(file.to_str().unwrap()), "{refusal}");
    assert_eq!(refusal.matches("cannot store results").count(), 1, "{refusal}");
    assert_eq!(std::fs::read(&file).unwrap(), b"not a directory");
}

#[tokio::test]
async fn two_services_cannot_share_a_data_directory() {
    let place = TempDir::new().unwrap();
    let config = ServeConfig { data: Some(place.path().to_owned()), memory_only: false, ..config(None) };
    let first = Service::open(&config).await.unwrap();
    let refusal = refusal(&config).await;
    assert!(refusal.contains(place.path().to_str().unwrap()) && refusal.contains("in use"), "{refusal}");
    assert_eq!(ask(&first.router, json!({"tolerance": 50})).await.status, 200);
}
