//! Shutdown of a service on a socket.

use tempfile::TempDir;
use tokio::io::AsyncWriteExt;
use tokio::net::TcpListener;

use super::{asked, in_time, rest, serve};
use crate::cli::verne;

#[tokio::test]
async fn shutdown_closes_idle_connections_and_finishes_requests() {
    let served = serve("--drain 60 --header-timeout 60 --timeout 60").await;
    let (mut idle, mut silent, mut busy) =
        (served.connect().await, served.connect().await, served.connect().await);
    assert!(asked(&mut idle).await && asked(&mut busy).await);
    let body = r#"{"joints": {"rho": [674, 685, 250]}}"#;
    let (first, second) = body.split_at(10);
    let length = body.len();
    let head = format!(
        "POST /fk HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: {length}"
    );
    busy.write_all(format!("{head}\r\nExpect: 100-continue\r\n\r\n").as_bytes()).await.unwrap();
    // The service asks for the body: the request has started.
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
async fn a_stalled_client_does_not_delay_shutdown() {
    let served = serve("--drain 1 --header-timeout 600 --timeout 600").await;
    let mut stream = served.connect().await;
    assert!(asked(&mut stream).await);
    stream.write_all(b"GET /livez HTTP/1.1\r\nx-slow: ").await.unwrap();
    served.end().await;
    assert_eq!(rest(&mut stream).await, "");
}

#[tokio::test]
async fn shutdown_ends_the_wait_for_the_broker() {
    // Nobody listens there.
    let broker = TcpListener::bind("127.0.0.1:0").await.unwrap().local_addr().unwrap();
    let place = TempDir::new().unwrap();
    let store = format!("file://{}", place.path().display());
    verne(&format!("store init {store}")).unwrap();
    serve(&format!("--broker nats://{broker} --store {store}")).await.end().await;
}

#[cfg(unix)]
#[tokio::test]
async fn a_hangup_signal_without_keys_changes_nothing() {
    let served = serve("").await;
    let mut stream = served.connect().await;
    assert!(asked(&mut stream).await);
    let process = std::process::id().to_string();
    assert!(std::process::Command::new("kill").args(["-HUP", &process]).status().unwrap().success());
    assert!(asked(&mut stream).await);
    drop(stream);
    served.end().await;
}
