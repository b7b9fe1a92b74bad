//! Clients that send or read slowly, or not at all.

use axum::body::Body;
use axum::http::{Request, StatusCode};
use tokio::io::AsyncWriteExt;

use super::http2::{http2, question};
use super::{asked, in_time, rest, serve};

/// How a connection may begin and then say nothing more: not at all, HTTP/1 in its first line and in its headers,
/// HTTP/2 within and after its preface, the last without answering a ping.
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
    served.end().await;
}

#[tokio::test]
async fn slow_headers_are_disconnected() {
    let served = serve("--header-timeout 1").await;
    let mut stream = served.connect().await;
    stream.write_all(b"GET /livez HTTP/1.1\r\nx-slow: ").await.unwrap();
    let trickling = async {
        while stream.write_all(b"x").await.is_ok() {
            tokio::time::sleep(std::time::Duration::from_millis(50)).await;
        }
    };
    in_time(trickling).await;
    served.end().await;
}

#[tokio::test]
async fn an_idle_connection_is_closed() {
    let served = serve("--header-timeout 1").await;
    let mut stream = served.connect().await;
    assert!(asked(&mut stream).await);
    assert_eq!(rest(&mut stream).await, "");
    served.end().await;
}

#[tokio::test]
async fn an_idle_http2_connection_is_closed() {
    let served = serve("--header-timeout 1").await;
    // A request is in progress until the client has read the answer.
    let (mut busy, _) = http2(served.connect().await).await;
    let request = Request::get("http://localhost/docs/swagger-ui-bundle.js").body(Body::empty()).unwrap();
    let answer = in_time(busy.send_request(request)).await.unwrap();
    let (mut used, used_to_its_end) = http2(served.connect().await).await;
    let (unused, unused_to_its_end) = http2(served.connect().await).await;
    assert_eq!(in_time(used.send_request(question())).await.unwrap().status(), StatusCode::OK);
    // They answer pings, and come to an end however they end.
    let _ = in_time(used_to_its_end).await.unwrap();
    let _ = in_time(unused_to_its_end).await.unwrap();
    assert_eq!(in_time(busy.send_request(question())).await.unwrap().status(), StatusCode::OK);
    drop((answer, busy, used, unused));
    served.end().await;
}

#[tokio::test]
async fn a_request_whose_body_stalls_times_out() {
    let served = serve("--timeout 1").await;
    let mut stream = served.connect().await;
    let head = "POST /fk HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: 1000\r\n\r\n{";
    stream.write_all(head.as_bytes()).await.unwrap();
    let answer = rest(&mut stream).await;
    assert!(answer.starts_with("HTTP/1.1 503 ") && answer.contains("timed_out"), "{answer}");
    served.end().await;
}

#[tokio::test]
async fn a_client_that_does_not_read_is_disconnected() {
    let served = serve("--timeout 1").await;
    let mut stream = served.connect().await;
    // Questions without end, none of whose answers is read: that writing fails shows the end of it.
    let question = "GET /docs/swagger-ui-bundle.js HTTP/1.1\r\nHost: localhost\r\n\r\n";
    in_time(async { while stream.write_all(question.as_bytes()).await.is_ok() {} }).await;
    assert!(asked(&mut served.connect().await).await);
    served.end().await;
}

#[tokio::test]
async fn an_http2_client_that_does_not_read_is_disconnected() {
    let served = serve("--timeout 1").await;
    // It answers pings, and leaves a few bytes of the answer where they are.
    let (mut client, connection) = http2(served.connect().await).await;
    let request = Request::get("http://localhost/docs/swagger-ui-bundle.js").body(Body::empty()).unwrap();
    let answer = in_time(client.send_request(request)).await.unwrap();
    // However it ends, it ends.
    let _ = in_time(connection).await.unwrap();
    drop((answer, client));
    served.end().await;
}
