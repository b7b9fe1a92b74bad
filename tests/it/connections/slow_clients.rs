//! Clients that are slow, or send and read nothing.

use axum::body::Body;
use axum::http::{Request, StatusCode};
use tokio::io::AsyncWriteExt;

use super::http2::{http2, http2_with_window, liveness_probe};
use super::{in_time, probe, rest, serve};

/// First bytes of clients that then send nothing more: none, a part of a first line and of the headers of HTTP/1, a part
/// of the preface of HTTP/2, and all of it.
const BEGINNINGS: [&[u8]; 5] = [
    b"",
    b"GET /liv",
    b"GET /livez HTTP/1.1\r\nHost: localhost\r\nx-slow: ",
    b"PRI * HTTP/2.0\r\n",
    b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n\0\0\0\x04\0\0\0\0\0",
];

#[tokio::test]
async fn unfinished_headers_are_disconnected() {
    let served = serve("--header-timeout 1").await;
    let mut open = Vec::new();
    for beginning in BEGINNINGS {
        let mut stream = served.connect().await;
        stream.write_all(beginning).await.unwrap();
        open.push(stream);
    }
    for mut stream in open {
        assert!(!rest(&mut stream).await.contains(" 200 "));
    }
    served.stop().await;
}

#[tokio::test]
async fn slow_headers_are_disconnected() {
    let served = serve("--header-timeout 1").await;
    let mut stream = served.connect().await;
    stream.write_all(b"GET /livez HTTP/1.1\r\nx-slow: ").await.unwrap();
    let sending = async {
        while stream.write_all(b"x").await.is_ok() {
            tokio::time::sleep(std::time::Duration::from_millis(50)).await;
        }
    };
    in_time(sending).await;
    served.stop().await;
}

#[tokio::test]
async fn idle_connections_are_closed() {
    let served = serve("--header-timeout 1").await;
    let mut stream = served.connect().await;
    assert!(probe(&mut stream).await);
    assert_eq!(rest(&mut stream).await, "");
    served.stop().await;
}

#[tokio::test]
async fn idle_http2_connections_are_closed() {
    let served = serve("--header-timeout 1").await;
    // The client does not read the response, so the request is in progress.
    let (mut busy, _) = http2(served.connect().await).await;
    let request = Request::get("http://localhost/docs/swagger-ui-bundle.js").body(Body::empty()).unwrap();
    let answer = in_time(busy.send_request(request)).await.unwrap();
    let (mut used, used_to_its_end) = http2(served.connect().await).await;
    let (unused, unused_to_its_end) = http2(served.connect().await).await;
    assert_eq!(in_time(used.send_request(liveness_probe())).await.unwrap().status(), StatusCode::OK);
    // The clients answer pings. Their connections end, with or without an error.
    let _ = in_time(used_to_its_end).await.unwrap();
    let _ = in_time(unused_to_its_end).await.unwrap();
    assert_eq!(in_time(busy.send_request(liveness_probe())).await.unwrap().status(), StatusCode::OK);
    drop((answer, busy, used, unused));
    served.stop().await;
}

#[tokio::test]
async fn requests_without_their_bodies_time_out() {
    let served = serve("--timeout 1").await;
    let mut stream = served.connect().await;
    let head = "POST /fk HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n\
                Content-Length: 1000\r\n\r\n{";
    stream.write_all(head.as_bytes()).await.unwrap();
    let answer = rest(&mut stream).await;
    assert!(answer.starts_with("HTTP/1.1 503 ") && answer.contains("timed_out"), "{answer}");
    assert!(
        answer.contains("did not arrive within 1 s") && answer.contains("Content-Encoding: gzip"),
        "{answer}"
    );
    served.stop().await;
}

#[tokio::test]
async fn clients_that_read_nothing_are_disconnected() {
    let served = serve("--timeout 1").await;
    let mut stream = served.connect().await;
    // The client sends requests and reads no response until the service closes the connection.
    let request = "GET /docs/swagger-ui-bundle.js HTTP/1.1\r\nHost: localhost\r\n\r\n";
    in_time(async { while stream.write_all(request.as_bytes()).await.is_ok() {} }).await;
    assert!(probe(&mut served.connect().await).await);
    served.stop().await;
}

#[tokio::test]
async fn http2_clients_that_read_nothing_are_disconnected() {
    let served = serve("--timeout 1").await;
    // The client answers pings and reads nothing of the response.
    let (mut client, connection) = http2(served.connect().await).await;
    let request = Request::get("http://localhost/docs/swagger-ui-bundle.js").body(Body::empty()).unwrap();
    let answer = in_time(client.send_request(request)).await.unwrap();
    // The connection ends, with or without an error.
    let _ = in_time(connection).await.unwrap();
    drop((answer, client));
    served.stop().await;
}

#[tokio::test]
async fn http2_clients_that_open_no_window_are_disconnected() {
    let served = serve("--timeout 1").await;
    // The client answers pings and never lets the service send the first byte of the body.
    let (mut client, connection) = http2_with_window(served.connect().await, 0).await;
    let response = in_time(client.send_request(liveness_probe())).await.unwrap();
    let _ = in_time(connection).await.unwrap();
    drop((response, client));
    served.stop().await;
}
