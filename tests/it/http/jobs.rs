//! Jobs: requesting, waiting and following; equal requests are one job.

use std::num::NonZeroUsize;

use axum::Router;
use axum::body::Body;
use axum::http::header::{CACHE_CONTROL, CONTENT_TYPE, LOCATION, RETRY_AFTER};
use axum::http::{HeaderName, Method, Request, StatusCode};
use http_body_util::BodyExt;
use serde_json::{Value, json};
use tower::ServiceExt;
use verne_service::ServeConfig;

use super::workspace::ask;
use super::{Reply, config, get_from, json_request, opened, send_to, service};

const PREFER: HeaderName = HeaderName::from_static("prefer");

/// Settings with one core for jobs, of which a second long one waits for the first, and with patience for a busy
/// machine.
pub(super) fn one_core() -> ServeConfig {
    ServeConfig { job_threads: Some(NonZeroUsize::MIN), wait: 500, timeout: 600, ..config(None) }
}

/// A question of minutes; another one for another `first` of the same hundred.
pub(super) fn long(first: u32) -> Value {
    json!({"kind": "part", "tool_length": {"from": first, "to": first + 99, "step": 1}, "tolerance": 0.02})
}

/// A question of milliseconds.
pub(super) fn small(tool_length: u32) -> Value {
    json!({"kind": "tool", "tool_length": tool_length, "tolerance": 50})
}

/// A table of small ones that counts as long: not for the express lane.
pub(super) fn table() -> Value {
    json!({"kind": "tool", "tool_length": {"from": 1, "to": 140, "step": 1}, "tolerance": 100})
}

/// POST /workspace with a preference.
pub(super) fn preferring(preference: &str, question: &Value) -> Request<Body> {
    let mut request = json_request(Method::POST, "/workspace", question);
    request.headers_mut().insert(PREFER, preference.parse().unwrap());
    request
}

/// Has a question computed without waiting for it; the id.
pub(super) async fn start(service: &Router, question: &Value) -> String {
    let reply = send_to(service.clone(), preferring("respond-async", question)).await;
    assert_eq!(reply.status, StatusCode::ACCEPTED, "{}", reply.json);
    reply.json["id"].as_str().unwrap().to_owned()
}

/// GET /jobs/{id}.
pub(super) async fn job(service: &Router, id: &str) -> Value {
    let reply = get_from(service, &format!("/jobs/{id}"), &[]).await;
    assert_eq!(reply.status, StatusCode::OK, "{}", reply.json);
    assert_eq!(reply.headers[CACHE_CONTROL], "no-store");
    reply.json
}

/// DELETE /jobs/{id}.
pub(super) async fn cancel(service: &Router, id: &str) -> Reply {
    let request = Request::delete(format!("/jobs/{id}")).body(Body::empty()).unwrap();
    send_to(service.clone(), request).await
}

/// A metric.
pub(super) async fn metric(service: &Router, name: &str) -> u64 {
    let text = String::from_utf8(get_from(service, "/metrics", &[]).await.bytes).unwrap();
    let value = text.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(' '));
    value.unwrap().parse().unwrap()
}

/// Follows a job's events until one is as wanted.
pub(super) async fn until(service: &Router, id: &str, wanted: impl Fn(&Value) -> bool) -> Value {
    let request = Request::get(format!("/jobs/{id}/events")).body(Body::empty()).unwrap();
    let mut body = service.clone().oneshot(request).await.unwrap().into_body();
    let mut text = String::new();
    while let Some(frame) = body.frame().await {
        text.push_str(std::str::from_utf8(&frame.unwrap().into_data().unwrap()).unwrap());
        while let Some((event, rest)) = text.split_once("\n\n") {
            let event = data(event);
            text = rest.to_owned();
            if let Some(job) = event.filter(&wanted) {
                return job;
            }
        }
    }
    panic!("the events ended before");
}

/// All events from now to the last.
pub(super) async fn events(service: &Router, id: &str) -> Vec<Value> {
    let reply = get_from(service, &format!("/jobs/{id}/events"), &[]).await;
    assert_eq!(reply.headers[CONTENT_TYPE], "text/event-stream");
    assert_eq!(reply.headers[CACHE_CONTROL], "no-store");
    String::from_utf8(reply.bytes).unwrap().split("\n\n").filter_map(data).collect()
}

/// The job in an event; comments keep a connection alive.
fn data(event: &str) -> Option<Value> {
    let json = event.lines().find_map(|line| line.strip_prefix("data: "))?;
    Some(serde_json::from_str(json).unwrap())
}

/// Asks again and again until some job is in a state; its id.
pub(super) async fn listed(service: &Router, state: &str) -> String {
    loop {
        let list = get_from(service, &format!("/jobs?state={state}"), &[]).await.json;
        if let Some(id) = list["jobs"][0]["id"].as_str() {
            return id.to_owned();
        }
        tokio::task::yield_now().await;
    }
}

#[tokio::test]
async fn a_client_follows_a_job_to_its_result() {
    let service = service().await;
    let question = json!({"kind": "part", "tool_length": [50, 60], "tolerance": 1});
    let accepted = send_to(service.clone(), preferring("respond-async", &question)).await;
    assert_eq!(accepted.status, StatusCode::ACCEPTED);
    let id = accepted.json["id"].as_str().unwrap();
    assert_eq!(accepted.headers[LOCATION], format!("/jobs/{id}"));
    assert_eq!(accepted.headers["preference-applied"], "respond-async");
    assert_eq!(accepted.headers[CACHE_CONTROL], "no-store");
    assert!(accepted.headers.contains_key(RETRY_AFTER));
    assert_eq!(
        accepted.json["links"],
        json!({"self": format!("/jobs/{id}"), "events": format!("/jobs/{id}/events")})
    );
    assert_eq!(accepted.json["request"]["tool_length"], json!([50.0, 60.0]));
    assert_eq!((&accepted.json["result"], &accepted.json["error"]), (&Value::Null, &Value::Null));

    let events = events(&service, id).await;
    let progress: Vec<f64> = events.iter().map(|job| job["progress"].as_f64().unwrap()).collect();
    assert!(progress.is_sorted(), "{progress:?}");
    let last = events.last().unwrap();
    assert_eq!((&last["state"], &last["progress"]), (&json!("succeeded"), &json!(1.0)));
    assert_eq!(*last, job(&service, id).await);
    for time in ["created", "started", "finished"] {
        assert!(last[time].as_str().unwrap().ends_with('Z'), "{last}");
    }

    let result = get_from(&service, last["result"].as_str().unwrap(), &[]).await;
    let synchronous = ask(&super::service().await, question.clone()).await;
    assert_eq!((synchronous.status, &synchronous.bytes), (StatusCode::OK, &result.bytes));
    let again = send_to(service, preferring("respond-async", &question)).await;
    assert_eq!((again.status, again.bytes), (StatusCode::OK, result.bytes));
}

#[tokio::test]
async fn a_mesh_request_can_become_a_job() {
    let service = service().await;
    let question = json!({"kind": "part", "tool_length": 50, "tolerance": 5});
    let mut request = preferring("respond-async", &question);
    *request.uri_mut() = "/workspace?format=stl".parse().unwrap();
    let accepted = send_to(service.clone(), request).await;
    assert_eq!(accepted.status, StatusCode::ACCEPTED);
    let last = events(&service, accepted.json["id"].as_str().unwrap()).await.pop().unwrap();
    let mesh =
        get_from(&service, &format!("{}/mesh?format=stl", last["result"].as_str().unwrap()), &[]).await;
    let uri = "/workspace?kind=part&tool_length=50&tolerance=5&format=stl";
    assert_eq!(mesh.bytes, get_from(&super::service().await, uri, &[]).await.bytes);
}

#[tokio::test]
async fn the_client_chooses_the_wait_within_the_limit() {
    let service = opened(&ServeConfig { timeout: 2, wait: 0, ..config(None) }).await;
    for (preference, question, status, applied) in [
        ("wait=100", long(0), StatusCode::ACCEPTED, "wait=1"),
        ("wait=0", long(100), StatusCode::ACCEPTED, "respond-async"),
    ] {
        let reply = send_to(service.clone(), preferring(preference, &question)).await;
        assert_eq!((reply.status, &reply.headers["preference-applied"]), (status, &applied.parse().unwrap()));
    }
    let unsaid = send_to(service.clone(), json_request(Method::POST, "/workspace", long(200))).await;
    assert_eq!(unsaid.status, StatusCode::ACCEPTED);
    assert!(!unsaid.headers.contains_key("preference-applied"));
    let patient = send_to(super::service().await, preferring("wait=20", &small(50))).await;
    assert_eq!(
        (patient.status, &patient.headers["preference-applied"]),
        (StatusCode::OK, &"wait=20".parse().unwrap())
    );
}

#[tokio::test]
async fn a_thousand_equal_requests_are_computed_once() {
    let service = opened(&one_core()).await;
    let question = || json_request(Method::POST, "/workspace", json!({"kind": "part", "tolerance": 0.1}));
    let asking: Vec<_> = (0..1000).map(|_| tokio::spawn(send_to(service.clone(), question()))).collect();
    let mut replies = Vec::new();
    for asked in asking {
        replies.push(asked.await.unwrap());
    }
    assert!(replies.iter().all(|reply| reply.status == StatusCode::OK && reply.bytes == replies[0].bytes));
    assert_eq!(metric(&service, "verne_computations_total").await, 1);
}

#[tokio::test]
async fn the_metrics_report_the_job_slots() {
    let service = opened(&one_core()).await;
    assert_eq!(metric(&service, "verne_worker_seats").await, 3);
    assert_eq!(metric(&service, "verne_worker_seats_busy").await, 0);
    start(&service, &long(0)).await;
    assert_eq!(metric(&service, "verne_worker_seats_busy").await, 1);
}
