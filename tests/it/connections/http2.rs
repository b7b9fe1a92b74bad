//! HTTP/2 without TLS, by prior knowledge.

use axum::body::Body;
use axum::http::{Request, StatusCode};
use http_body_util::BodyExt;
use hyper::client::conn::http2::{Builder, SendRequest};
use hyper_util::rt::{TokioExecutor, TokioIo};
use tokio::io::{AsyncRead, AsyncWrite};
use tokio::task::JoinHandle;

use super::{in_time, serve};

/// Opens HTTP/2 on a stream with a small window for unread answers; also returns the end of the connection.
pub(super) async fn http2(
    io: impl AsyncRead + AsyncWrite + Unpin + Send + 'static,
) -> (SendRequest<Body>, JoinHandle<hyper::Result<()>>) {
    let mut builder = Builder::new(TokioExecutor::new());
    let handshake = builder.initial_stream_window_size(65_535).handshake(TokioIo::new(io));
    let (client, connection) = handshake.await.unwrap();
    (client, tokio::spawn(connection))
}

/// Asks whether the service lives.
pub(super) fn question() -> Request<Body> {
    Request::get("http://localhost/livez").body(Body::empty()).unwrap()
}

#[tokio::test]
async fn http2_answers_many_requests_on_one_connection() {
    let served = serve("").await;
    let (client, _) = http2(served.connect().await).await;
    let answers: Vec<_> = (0..50)
        .map(|_| {
            let mut client = client.clone();
            tokio::spawn(async move {
                client.ready().await.unwrap();
                let answer = client.send_request(question()).await.unwrap();
                (answer.status(), answer.into_body().collect().await.unwrap().to_bytes())
            })
        })
        .collect();
    for answer in answers {
        assert_eq!(in_time(answer).await.unwrap(), (StatusCode::OK, "{\"status\":\"ok\"}".into()));
    }
    served.end().await;
}

#[tokio::test]
async fn large_http2_headers_are_refused() {
    let served = serve("").await;
    let (mut client, _) = http2(served.connect().await).await;
    let mut request = question();
    request.headers_mut().insert("x-long", "x".repeat(100_000).parse().unwrap());
    let refused = in_time(client.send_request(request)).await;
    assert!(
        refused.is_err()
            || refused.is_ok_and(|answer| answer.status() == StatusCode::REQUEST_HEADER_FIELDS_TOO_LARGE)
    );
    served.end().await;
}
