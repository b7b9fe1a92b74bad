//! Limits of concurrent requests, batches and memory.

use std::convert::Infallible;

use axum::Router;
use axum::body::{Body, Bytes};
use axum::http::header::RETRY_AFTER;
use axum::http::{Method, Request, StatusCode};
use futures_util::stream;
use http_body_util::BodyExt;
use serde_json::{Value, json};
use tokio::sync::oneshot;
use tokio::task::JoinHandle;
use tower::ServiceExt;
use verne_service::ServeConfig;

use super::jobs::{long, metric, one_core, start};
use super::workspace::ask;
use super::{Reply, config, get_from, json_request, opened, send_to};

const FK: &str = "/fk?rho=674,685,250";

/// A request whose body is being read and does not end yet.
struct Held {
    end: oneshot::Sender<()>,
    reply: JoinHandle<Reply>,
}

impl Held {
    /// Returns when the body is being read.
    async fn post(service: &Router, uri: &str, body: &Value) -> Self {
        let ((begins, begun), (end, ended)) = (oneshot::channel(), oneshot::channel());
        let bytes = Bytes::from(body.to_string());
        let body = stream::once(async move {
            begins.send(()).unwrap();
            ended.await.unwrap();
            Ok::<_, Infallible>(bytes)
        });
        let request = json_request(Method::POST, uri, "").map(|_| Body::from_stream(body));
        let reply = tokio::spawn(send_to(service.clone(), request));
        begun.await.unwrap();
        Self { end, reply }
    }

    async fn end(self) -> Reply {
        self.end.send(()).unwrap();
        self.reply.await.unwrap()
    }
}

async fn at_most(max_requests: usize) -> Router {
    opened(&ServeConfig { max_requests, ..config(None) }).await
}

#[track_caller]
fn assert_overloaded(reply: &Reply) {
    reply.assert_problem(503, "overloaded");
    assert_eq!(reply.headers[RETRY_AFTER], "1");
}

#[tokio::test]
async fn batches_count_until_they_are_sent_and_leave_room_for_single_requests() {
    let service = at_most(8).await;
    let batch = json!({"joints": [[674, 685, 250]]});
    let more = || send_to(service.clone(), json_request(Method::POST, "/fk/batch", &batch));
    let mut held = Vec::new();
    for _ in 0..4 {
        let request = json_request(Method::POST, "/fk/batch", &batch);
        let response = service.clone().oneshot(request).await.unwrap();
        assert_eq!(response.status(), StatusCode::OK);
        held.push(response.into_body());
    }
    assert_overloaded(&more().await);
    let points = json_request(Method::POST, "/workspace/contains", json!({"points": [[0, 0, 900]]}));
    assert_overloaded(&send_to(service.clone(), points).await);
    for uri in [FK, "/jobs"] {
        assert_eq!(get_from(&service, uri, &[]).await.status, StatusCode::OK, "{uri}");
    }
    // An answer that the connection has taken is not sent yet.
    let handed_over = held.pop().unwrap().frame().await.unwrap().unwrap();
    assert_overloaded(&more().await);
    drop(handed_over);
    assert_eq!(more().await.status, StatusCode::OK);
}

#[tokio::test]
async fn stalled_bodies_do_not_count_as_batches() {
    let service = at_most(16).await;
    let batch = json!({"joints": [[674, 685, 250]]});
    let mut held = Vec::new();
    for _ in 0..8 {
        held.push(Held::post(&service, "/fk/batch", &batch).await);
    }
    let more = send_to(service.clone(), json_request(Method::POST, "/fk/batch", &batch));
    assert_eq!(more.await.status, StatusCode::OK);
    for held in held {
        assert_eq!(held.end().await.status, StatusCode::OK);
    }
}

#[tokio::test]
async fn requests_above_the_limit_are_refused_at_once() {
    let service = at_most(4).await;
    let mut held = Vec::new();
    for _ in 0..3 {
        held.push(Held::post(&service, "/workspace", &json!({"tolerance": 50})).await);
    }
    // The last place is reserved for single requests.
    for uri in ["/jobs", "/openapi.json", "/docs/", "/"] {
        assert_overloaded(&get_from(&service, uri, &[]).await);
    }
    assert_eq!(get_from(&service, FK, &[]).await.status, StatusCode::OK);
    held.push(Held::post(&service, "/fk", &json!({"joints": {"rho": [674, 685, 250]}})).await);
    assert_overloaded(&get_from(&service, FK, &[]).await);
    for uri in ["/livez", "/readyz", "/metrics"] {
        assert_eq!(get_from(&service, uri, &[]).await.status, StatusCode::OK, "{uri}");
    }
    for held in held {
        assert_eq!(held.end().await.status, StatusCode::OK);
    }
    assert_eq!(get_from(&service, "/jobs", &[]).await.status, StatusCode::OK);
}

#[tokio::test]
async fn waiting_for_a_job_does_not_count() {
    let service = opened(&ServeConfig { max_requests: 4, ..one_core() }).await;
    for number in 0..8 {
        let service = service.clone();
        tokio::spawn(async move { ask(&service, long(100 * number)).await });
    }
    // Refused are those that come before others wait; they come again.
    let mut asked = 8;
    loop {
        let reply = get_from(&service, "/jobs", &[]).await;
        if reply.status == StatusCode::OK && reply.json["jobs"].as_array().unwrap().len() == 8 {
            break;
        }
        let service = service.clone();
        tokio::spawn(async move { ask(&service, long(100 * (asked % 8))).await });
        asked += 1;
        tokio::task::yield_now().await;
    }
    assert_eq!(get_from(&service, FK, &[]).await.status, StatusCode::OK);
}

#[tokio::test]
async fn metrics_report_the_requests_in_progress() {
    let service = at_most(8).await;
    let told = async |names: [&str; 5]| {
        let mut values = Vec::new();
        for name in names {
            values.push(metric(&service, &format!("verne_{name}")).await);
        }
        values
    };
    let taken = [
        r#"places_taken{of="requests"}"#,
        r#"places_taken{of="work"}"#,
        r#"places_taken{of="batches"}"#,
        r#"memory_taken_bytes{of="bodies"}"#,
        r#"memory_taken_bytes{of="answers"}"#,
    ];
    assert_eq!(told(taken).await, [0; 5]);
    let limits = told(taken.map(|name| name.replace("taken", "limit")).each_ref().map(String::as_str)).await;
    assert_eq!(limits[..3], [8, 6, 4]);
    assert!(limits[3] > 0 && limits[4] == 2 << 30);

    let batch = json!({"joints": [[674, 685, 250]]});
    let held = Held::post(&service, "/fk/batch", &batch).await;
    assert_eq!(told(taken).await, [1, 1, 0, 16_384, 0], "the body is read");
    let request = json_request(Method::POST, "/fk/batch", &batch);
    let sent = service.clone().oneshot(request).await.unwrap();
    assert_eq!(told(taken).await, [1, 1, 1, 16_384, 16_384], "an answer is sent");
    drop(sent);
    assert_eq!(held.end().await.status, StatusCode::OK);
    assert_eq!(told(taken).await, [0; 5]);
}

#[tokio::test]
async fn ten_thousand_clients_follow_one_job() {
    let service = opened(&one_core()).await;
    let id = start(&service, &long(0)).await;
    let follow = || {
        let request = Request::get(format!("/jobs/{id}/events")).body(Body::empty()).unwrap();
        service.clone().oneshot(request)
    };
    let mut followers = Vec::new();
    loop {
        let response = follow().await.unwrap();
        if response.status() != StatusCode::OK {
            assert_eq!(response.status(), StatusCode::SERVICE_UNAVAILABLE);
            break;
        }
        followers.push(response);
    }
    assert!(followers.len() >= 10_000, "{}", followers.len());
    assert_eq!(metric(&service, r#"verne_places_taken{of="streams"}"#).await, followers.len() as u64);
    assert_eq!(get_from(&service, "/jobs", &[]).await.status, StatusCode::OK);
    followers.pop();
    assert_eq!(follow().await.unwrap().status(), StatusCode::OK);
}
