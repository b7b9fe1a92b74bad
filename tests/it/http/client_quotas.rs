//! One client's greatest share of the limits.

use std::convert::Infallible;
use std::future::pending;
use std::net::SocketAddr;

use axum::Router;
use axum::body::{Body, Bytes};
use axum::extract::ConnectInfo;
use axum::http::{Method, Request, StatusCode};
use futures_util::{FutureExt, stream};
use serde_json::json;
use tower::ServiceExt;
use verne_service::ServeConfig;

use super::keys::Keys;
use super::{config, json_request, opened};

async fn at_most_eight() -> Router {
    opened(&ServeConfig { max_requests: 8, ..config(None) }).await
}

fn from(address: &str, mut request: Request<Body>) -> Request<Body> {
    request.extensions_mut().insert(ConnectInfo(SocketAddr::new(address.parse().unwrap(), 1)));
    request
}

fn batch() -> Request<Body> {
    json_request(Method::POST, "/fk/batch", json!({"joints": [[674, 685, 250]]}))
}

/// A request whose body never comes.
fn endless() -> Request<Body> {
    let body = stream::once(pending::<Result<Bytes, Infallible>>());
    json_request(Method::POST, "/workspace", "").map(|_| Body::from_stream(body))
}

#[tokio::test]
async fn one_address_has_at_most_half_of_the_batches() {
    let service = at_most_eight().await;
    let ask = |address| service.clone().oneshot(from(address, batch()));
    let unread = [ask("192.0.2.1").await.unwrap(), ask("192.0.2.1").await.unwrap()];
    assert!(unread.iter().all(|answer| answer.status() == StatusCode::OK));
    assert_eq!(ask("192.0.2.1").await.unwrap().status(), StatusCode::SERVICE_UNAVAILABLE);
    assert_eq!(ask("192.0.2.2").await.unwrap().status(), StatusCode::OK);
    drop(unread);
    assert_eq!(ask("192.0.2.1").await.unwrap().status(), StatusCode::OK);
    // A proxy on this machine sends for everybody.
    let unread = [(); 4].map(|()| ask("127.0.0.1"));
    for answer in futures_util::future::join_all(unread).await {
        assert_eq!(answer.unwrap().status(), StatusCode::OK);
    }
}

#[tokio::test]
async fn one_address_has_at_most_half_of_the_requests() {
    let service = at_most_eight().await;
    let ask = |address, uri| {
        let request = Request::get(uri).body(Body::empty()).unwrap();
        service.clone().oneshot(from(address, request))
    };
    // Six of the eight are for what is no single question.
    let mut held = [(); 3].map(|()| Box::pin(service.clone().oneshot(from("2001:db8::1", endless()))));
    assert!(held.iter_mut().all(|request| request.now_or_never().is_none()));
    for uri in ["/jobs", "/openapi.json"] {
        let again = ask("2001:db8::2", uri).await.unwrap();
        assert_eq!(again.status(), StatusCode::SERVICE_UNAVAILABLE, "{uri}: of one network");
        assert_eq!(ask("192.0.2.1", uri).await.unwrap().status(), StatusCode::OK, "{uri}");
    }
    assert_eq!(ask("2001:db8::2", "/livez").await.unwrap().status(), StatusCode::OK);
    drop(held);
    assert_eq!(ask("2001:db8::2", "/jobs").await.unwrap().status(), StatusCode::OK);
}

#[tokio::test]
async fn one_key_has_at_most_half_of_the_batches_from_all_addresses() {
    let keys = Keys::new([("one", "read"), ("two", "read")]);
    let service = opened(&keys.asked_for_by(ServeConfig { max_requests: 8, ..config(None) })).await;
    let ask = |number, address| service.clone().oneshot(from(address, keys.sent(number, batch())));
    let unread = [ask(0, "192.0.2.1").await.unwrap(), ask(0, "127.0.0.1").await.unwrap()];
    assert!(unread.iter().all(|answer| answer.status() == StatusCode::OK));
    assert_eq!(ask(0, "192.0.2.2").await.unwrap().status(), StatusCode::SERVICE_UNAVAILABLE);
    assert_eq!(ask(1, "192.0.2.1").await.unwrap().status(), StatusCode::OK);
}
