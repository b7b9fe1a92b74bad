//! The limit of connections.

use tokio::io::AsyncWriteExt;
use tokio::net::TcpStream;

use super::{Served, asked, in_time, rest, serve};

/// The answer to a request for this path on a connection of its own, until its end.
async fn answer(served: &Served, path: &str) -> String {
    let mut stream = served.connect().await;
    stream.write_all(format!("GET {path} HTTP/1.1\r\nHost: localhost\r\n\r\n").as_bytes()).await.unwrap();
    rest(&mut stream).await
}

/// A service all of whose places, two of them, are taken.
async fn full(flags: &str) -> (Served, [TcpStream; 2]) {
    let served = serve(&format!("--max-connections 2 {flags}")).await;
    let (mut one, mut two) = (served.connect().await, served.connect().await);
    assert!(asked(&mut one).await && asked(&mut two).await);
    (served, [one, two])
}

#[tokio::test]
async fn the_number_of_connections_is_limited() {
    let (served, [mut one, two]) = full("").await;
    let refused = answer(&served, "/fk?rho=674,685,250").await;
    assert!(refused.starts_with("HTTP/1.1 503 "), "{refused}");
    for part in ["retry-after: 1\r\n", "connection: close\r\n", "application/problem+json", "overloaded"] {
        assert!(refused.contains(part), "{refused}");
    }
    assert!(asked(&mut one).await, "those that are open stay");
    drop(two);
    let mut again = served.connect().await;
    in_time(async {
        while !(asked(&mut again).await && asked(&mut again).await) {
            again = served.connect().await;
        }
    })
    .await;
    drop((one, again));
    served.end().await;
}

#[tokio::test]
async fn probes_are_answered_at_the_connection_limit() {
    let (served, open) = full("").await;
    for path in ["/livez", "/readyz", "/metrics"] {
        let answer = answer(&served, path).await;
        assert!(answer.starts_with("HTTP/1.1 200 OK"), "{answer}");
        assert!(answer.contains("connection: close\r\n"), "{answer}");
    }
    drop(open);
    served.end().await;
}

#[tokio::test]
async fn connections_are_counted_in_the_metrics() {
    let (served, open) = full("").await;
    for refused in 1..=2 {
        let metrics = answer(&served, "/metrics").await;
        for line in [
            "verne_connections_open 2\n".to_owned(),
            "verne_connections_limit 2\n".to_owned(),
            format!("verne_connections_refused_total {refused}\n"),
        ] {
            assert!(metrics.contains(&line), "{line}{metrics}");
        }
    }
    drop(open);
    in_time(async { while !answer(&served, "/metrics").await.contains("verne_connections_open 1\n") {} })
        .await;
    served.end().await;
}

#[tokio::test]
async fn reserved_connections_are_closed_after_the_header_timeout() {
    let (served, _open) = full("--header-timeout 2").await;
    let mut silent = Vec::new();
    for _ in 0..16 {
        silent.push(served.connect().await);
    }
    assert_eq!(rest(&mut served.connect().await).await, "");
    for mut silent in silent {
        assert_eq!(rest(&mut silent).await, "");
    }
    in_time(async { while !answer(&served, "/livez").await.starts_with("HTTP/1.1 200 OK") {} }).await;
    served.end().await;
}
