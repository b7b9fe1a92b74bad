//! Requests with heads that are malformed or too large.

use tokio::io::{AsyncReadExt, AsyncWriteExt};

use super::{Served, in_time, rest, serve};

/// The response to these bytes. The client keeps its direction open.
async fn answered(served: &Served, request: impl AsRef<[u8]>) -> String {
    let mut stream = served.connect().await;
    stream.write_all(request.as_ref()).await.unwrap();
    rest(&mut stream).await
}

fn request_for(path: &str, headers: &str) -> String {
    format!("GET {path} HTTP/1.1\r\nOrigin: https://example.org\r\n{headers}Connection: close\r\n\r\n")
}

/// Asserts a problem document with this status and code, a request id and CORS headers.
#[track_caller]
fn assert_problem(answer: &str, status: u16, code: &str) {
    let (head, body) = answer.split_once("\r\n\r\n").unwrap_or_else(|| panic!("{answer}"));
    assert!(head.starts_with(&format!("HTTP/1.1 {status} ")), "{head}");
    for line in [
        "content-type: application/problem+json",
        "x-request-id: ",
        "access-control-allow-origin: https://example.org",
        "connection: close",
        &format!("content-length: {}", body.len()),
    ] {
        assert!(head.contains(line), "{line}: {head}");
    }
    let problem: serde_json::Value = serde_json::from_str(body).unwrap();
    assert_eq!((&problem["status"], &problem["code"]), (&status.into(), &code.into()), "{problem}");
}

#[tokio::test]
async fn malformed_heads_are_answered_with_a_problem_document() {
    let served = serve("--cors-origin https://example.org").await;
    for (path, headers) in [
        ("/fk", ""),
        ("/fk", "Host: \r\n"),
        ("/fk", "Host: a b\r\n"),
        ("/fk", "Host: me@localhost\r\n"),
        ("/fk", "Host: localhost\r\nHost: localhost\r\n"),
        ("/fk", "Host: localhost\r\nbad header: x\r\n"),
        ("/fk", "Host: localhost\r\nContent-Length: x\r\n"),
        ("fk", "Host: localhost\r\n"),
    ] {
        assert_problem(&answered(&served, request_for(path, headers)).await, 400, "bad_request");
    }
    let [before, after] = ["GET /fk", " HTTP/1.1\r\nHost: localhost\r\nOrigin: https://example.org\r\n\r\n"];
    let request = [before.as_bytes(), b"\xff\xfe", after.as_bytes()].concat();
    assert_problem(&answered(&served, request).await, 400, "bad_request");
    served.stop().await;
}

#[tokio::test]
async fn large_heads_are_rejected() {
    let served = serve("--cors-origin https://example.org").await;
    let localhost = "Host: localhost\r\n";
    let uri = format!("/fk?rho={}", "1".repeat(20_000));
    assert_problem(&answered(&served, request_for(&uri, localhost)).await, 414, "uri_too_long");
    let long = |bytes: usize| format!("{localhost}x-long: {}\r\n", "x".repeat(bytes));
    for headers in [long(40_000), long(100_000), format!("{localhost}{}", "x: y\r\n".repeat(200))] {
        let answer = answered(&served, request_for("/fk", &headers)).await;
        assert_problem(&answer, 431, "headers_too_large");
    }
    // The service does not read as far as the origin.
    let uri = format!("/fk?rho={}", "1".repeat(100_000));
    let answer = answered(&served, request_for(&uri, localhost)).await;
    assert!(answer.starts_with("HTTP/1.1 414 ") && answer.contains("uri_too_long"), "{answer}");
    served.stop().await;
}

#[tokio::test]
async fn a_malformed_head_ends_a_connection_after_earlier_responses() {
    let served = serve("--cors-origin https://example.org").await;
    let mut stream = served.connect().await;
    assert!(super::probe(&mut stream).await);
    stream.write_all(b"GET / HTTP/9.9\r\nOrigin: https://example.org\r\n\r\n").await.unwrap();
    assert_problem(&rest(&mut stream).await, 400, "bad_request");
    served.stop().await;
}

#[tokio::test]
async fn the_service_does_not_ask_for_a_body_that_is_too_large() {
    let served = serve("--cors-origin https://example.org --max-body-bytes 1000000").await;
    for (path, bytes) in [("/fk", 70_000), ("/fk/batch", 2_000_000)] {
        let head = format!(
            "POST {path} HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: {bytes}\r\n\
             Expect: 100-continue\r\nOrigin: https://example.org\r\n\r\n"
        );
        let mut stream = served.connect().await;
        stream.write_all(head.as_bytes()).await.unwrap();
        let mut begin = [0; 12];
        in_time(stream.read_exact(&mut begin)).await.unwrap();
        assert_eq!(&begin, b"HTTP/1.1 413", "{path}");
    }
    served.stop().await;
}
