//! The request rate of one client.

use std::net::SocketAddr;
use std::num::NonZeroU32;

use axum::Router;
use axum::body::Body;
use axum::extract::ConnectInfo;
use axum::http::header::RETRY_AFTER;
use axum::http::{Request, StatusCode};
use verne_service::ServeConfig;

use super::keys::{Keys, fresh};
use super::{Reply, config, opened, send_to};

async fn from(service: &Router, address: &str, uri: &str) -> Reply {
    let mut request = Request::get(uri).body(Body::empty()).unwrap();
    request.extensions_mut().insert(ConnectInfo(address.parse::<SocketAddr>().unwrap()));
    send_to(service.clone(), request).await
}

/// Asks until it is refused; how often it was answered. A bucket that is filled once a second runs dry soon.
async fn until_refused(mut ask: impl AsyncFnMut() -> Reply) -> usize {
    for answered in 0..100_000 {
        let reply = ask().await;
        if reply.status != StatusCode::OK {
            reply.assert_problem(429, "too_many_requests");
            assert_eq!(reply.headers[RETRY_AFTER], "1");
            return answered;
        }
    }
    panic!("never refused");
}

#[tokio::test]
async fn an_address_above_its_rate_gets_retry_after() {
    let burst = NonZeroU32::new(3);
    let service = opened(&ServeConfig { rate: 1, rate_burst: burst, ..config(None) }).await;
    assert!(until_refused(async || from(&service, "10.0.0.1:1", "/machines").await).await >= 3);
    // Ports are one client's; the probes answer in any case.
    assert!(until_refused(async || from(&service, "10.0.0.1:2", "/machines").await).await < 1000);
    assert!(until_refused(async || from(&service, "10.0.0.1:2", "/openapi.json").await).await < 1000);
    for uri in ["/livez", "/readyz", "/metrics"] {
        assert_eq!(from(&service, "10.0.0.1:1", uri).await.status, StatusCode::OK, "{uri}");
    }
    assert_eq!(from(&service, "10.0.0.2:1", "/machines").await.status, StatusCode::OK);
}

#[tokio::test]
async fn requests_are_unlimited_without_a_rate() {
    let service = opened(&config(None)).await;
    for _ in 0..1000 {
        assert_eq!(from(&service, "10.0.0.1:1", "/machines").await.status, StatusCode::OK);
    }
}

#[tokio::test]
async fn a_key_has_one_rate_for_all_addresses() {
    let keys = Keys::new([("slow", "read"), ("free", "read"), ("usual", "read")]);
    let text = std::fs::read_to_string(keys.file()).unwrap();
    let (slow, others) = text.split_once("\n\n").unwrap();
    let (free, usual) = others.split_once("\n\n").unwrap();
    keys.write(&format!("{slow}\nrate = 1\nrate_burst = 500\n{free}\nrate = 0\n{usual}"));
    let service = opened(&keys.asked_for_by(ServeConfig { rate: 1, ..config(None) })).await;
    let answered = async |number| until_refused(async || keys.get(&service, number, "/machines").await).await;
    assert!(answered(2).await < 500);
    assert!(answered(0).await >= 500);
    for _ in 0..1000 {
        assert_eq!(keys.get(&service, 1, "/machines").await.status, StatusCode::OK);
    }
    // Operations without a key are limited by address.
    assert!(until_refused(async || from(&service, "10.0.0.1:1", "/openapi.json").await).await < 500);
    assert_eq!(from(&service, "10.0.0.2:1", "/openapi.json").await.status, StatusCode::OK);
    // Requests without a key do not count against a key.
    let (unknown, _) = fresh("slow", "read");
    let request = Request::get("/machines").header("authorization", format!("Bearer {unknown}"));
    send_to(service, request.body(Body::empty()).unwrap()).await.assert_problem(401, "unauthorized");
}

#[tokio::test]
async fn unknown_paths_and_unknown_keys_count_as_requests() {
    let keys = Keys::new([("cam", "read")]);
    let burst = NonZeroU32::new(3);
    let service = opened(&ServeConfig { rate: 1, rate_burst: burst, ..config(None) }).await;
    let unknown = async || match from(&service, "10.0.0.1:1", "/nowhere").await {
        reply if reply.status == StatusCode::NOT_FOUND => Reply { status: StatusCode::OK, ..reply },
        reply => reply,
    };
    assert!(until_refused(unknown).await < 1000);

    let service =
        opened(&keys.asked_for_by(ServeConfig { rate: 1, rate_burst: burst, ..config(None) })).await;
    for uri in ["/machines", "/metrics"] {
        let unknown = async || match from(&service, "10.0.0.1:1", uri).await {
            reply if reply.status == StatusCode::UNAUTHORIZED => Reply { status: StatusCode::OK, ..reply },
            reply => reply,
        };
        assert!(until_refused(unknown).await < 1000, "{uri}");
    }
    // A key is not limited by others who try keys from the same address.
    let mut known = keys.sent(0, Request::get("/machines").body(Body::empty()).unwrap());
    known.extensions_mut().insert(ConnectInfo("10.0.0.1:1".parse::<SocketAddr>().unwrap()));
    assert_eq!(send_to(service, known).await.status, StatusCode::OK);
}
