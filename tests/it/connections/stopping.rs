//! The end of the service.

use tempfile::TempDir;
use tokio::io::AsyncWriteExt;
use tokio::net::TcpListener;

use super::{in_time, probe, rest, serve};
use crate::cli::verne;

#[tokio::test]
async fn a_stopping_service_closes_idle_connections_and_finishes_requests() {
    let served = serve("--drain 60 --header-timeout 60 --timeout 60").await;
    let (mut idle, mut silent, mut busy) =
        (served.connect().await, served.connect().await, served.connect().await);
    assert!(probe(&mut idle).await && probe(&mut busy).await);
    let body = r#"{"joints": {"rho": [674, 685, 250]}}"#;
    let (first, second) = body.split_at(10);
    let length = body.len();
    let head = format!(
        "POST /fk HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: {length}"
    );
    busy.write_all(format!("{head}\r\nExpect: 100-continue\r\n\r\n").as_bytes()).await.unwrap();
    // The service asks for the body, so the request is in progress.
    let mut expected = [0; 25];
    in_time(tokio::io::AsyncReadExt::read_exact(&mut busy, &mut expected)).await.unwrap();
    assert_eq!(&expected, b"HTTP/1.1 100 Continue\r\n\r\n");
    busy.write_all(first.as_bytes()).await.unwrap();

    drop(served.stop);
    assert_eq!(rest(&mut idle).await, "");
    assert_eq!(rest(&mut silent).await, "");
    busy.write_all(second.as_bytes()).await.unwrap();
    let answer = rest(&mut busy).await;
    assert!(answer.starts_with("HTTP/1.1 200 OK"), "{answer}");
    assert!(answer.contains("connection: close"), "{answer}");
    in_time(served.ended).await.unwrap();
}

#[tokio::test]
async fn an_unfinished_request_does_not_keep_a_stopping_service() {
    let served = serve("--drain 1 --header-timeout 600 --timeout 600").await;
    let mut stream = served.connect().await;
    assert!(probe(&mut stream).await);
    stream.write_all(b"GET /livez HTTP/1.1\r\nx-slow: ").await.unwrap();
    served.stop().await;
    assert_eq!(rest(&mut stream).await, "");
}

#[tokio::test]
async fn a_service_that_waits_for_the_broker_stops_at_once() {
    // No program listens there.
    let broker = TcpListener::bind("127.0.0.1:0").await.unwrap().local_addr().unwrap();
    let directory = TempDir::new().unwrap();
    let store = format!("file://{}", directory.path().display());
    verne(&format!("store init {store}")).unwrap();
    serve(&format!("--broker nats://{broker} --store {store}")).await.stop().await;
}

#[cfg(unix)]
#[tokio::test]
async fn sighup_does_not_end_a_service_without_keys() {
    let served = serve("").await;
    let mut stream = served.connect().await;
    assert!(probe(&mut stream).await);
    let process = std::process::id().to_string();
    assert!(std::process::Command::new("kill").args(["-HUP", &process]).status().unwrap().success());
    assert!(probe(&mut stream).await);
    drop(stream);
    served.stop().await;
}
