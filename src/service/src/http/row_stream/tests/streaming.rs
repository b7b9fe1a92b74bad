//! What happens between the first and the last row.

use std::convert::Infallible;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use axum::body::{Body, Bytes};
use axum::http::header::CONTENT_TYPE;
use axum::http::{Request, Response, StatusCode};
use futures_util::{StreamExt, stream};
use http_body_util::{BodyExt, Collected};
use serde_json::Value;
use tokio::sync::mpsc;
use tower::ServiceExt;
use verne_rows::Format;

use super::{columns, poses, post, written};
use crate::process::service::Service;
use crate::test_service::service;

const NAMES: [&str; 5] = ["x", "y", "z", "phi1", "phi2"];

/// The response to a body that a test sends piece by piece.
async fn open(service: &Service, format: Format) -> (mpsc::UnboundedSender<Bytes>, Response<Body>, Bytes) {
    let (sender, receiver) = mpsc::unbounded_channel();
    let whole = Bytes::from(written(format, &columns(&NAMES, &poses(200))));
    sender.send(whole.slice(..whole.len() * 3 / 4)).unwrap();
    let pieces = stream::unfold(receiver, |mut receiver| async move {
        receiver.recv().await.map(|piece: Bytes| (Ok::<_, Infallible>(piece), receiver))
    });
    let request = Request::post("/ik/batch?tool_length=50").header(CONTENT_TYPE, format.media());
    let request = request.body(Body::from_stream(pieces)).unwrap();
    let response = service.router.clone().oneshot(request).await.unwrap();
    assert_eq!(response.status(), StatusCode::OK);
    (sender, response, whole.slice(whole.len() * 3 / 4..))
}

#[tokio::test]
async fn rows_are_answered_while_later_rows_arrive() {
    let service = service("").await;
    for format in [Format::Csv, Format::Ndjson] {
        let (sender, mut response, rest) = open(&service, format).await;
        let first = response.body_mut().frame().await.unwrap().unwrap().into_data().unwrap();
        assert!(first.split(|byte| *byte == b'\n').count() > 100, "before the rest is sent");
        sender.send(rest).unwrap();
        drop(sender);
        let last = response.into_body().collect().await.unwrap().to_bytes();
        assert!(last.split(|byte| *byte == b'\n').count() > 20);
    }
}

#[tokio::test]
async fn an_error_in_the_middle_is_reported_as_the_format_permits() {
    let service = service("").await;
    let long = Bytes::from(vec![b'1'; 200_000]);
    for format in [Format::Csv, Format::Ndjson] {
        let (sender, response, _) = open(&service, format).await;
        sender.send(long.clone()).unwrap();
        drop(sender);
        let answer = response.into_body().collect().await.map(Collected::to_bytes);
        match format {
            Format::Ndjson => {
                let answer = answer.unwrap();
                let last = answer.trim_ascii_end().rsplit(|byte| *byte == b'\n').next().unwrap();
                let last: Value = serde_json::from_slice(last).unwrap();
                assert_eq!(
                    (&last["error"]["code"], &last["error"]["status"]),
                    (&"bad_rows".into(), &422.into())
                );
            }
            _ => assert!(answer.is_err(), "the connection breaks off"),
        }
    }
    let whole = written(Format::Arrow, &columns(&NAMES, &poses(20_000)));
    let parts = [whole.clone(), whole[whole.len() / 2..].to_vec()].concat();
    let request = Request::post("/ik/batch").header(CONTENT_TYPE, Format::Arrow.media());
    let response = service.router.clone().oneshot(request.body(Body::from(parts)).unwrap()).await.unwrap();
    assert_eq!(response.status(), StatusCode::OK);
    assert!(response.into_body().collect().await.is_err());
}

#[tokio::test]
async fn the_memory_of_a_batch_does_not_grow_with_its_rows() {
    const LIMIT: usize = 1 << 20;
    let service = service(&format!("--max-body-bytes {LIMIT} --max-rows 1000")).await;
    let rows = Bytes::from(written(Format::Csv, &columns(&NAMES, &poses(1000))));
    let head = rows.iter().position(|byte| *byte == b'\n').unwrap() + 1;
    let (head, rows) = (rows.slice(..head), rows.slice(head..));
    let (sent, total) = (Arc::new(AtomicUsize::new(0)), 200);
    let counter = Arc::clone(&sent);
    let size = rows.len();
    let pieces =
        stream::iter(std::iter::once(head).chain(std::iter::repeat_n(rows, total))).map(move |piece| {
            counter.fetch_add(1, Ordering::Relaxed);
            Ok::<_, Infallible>(piece)
        });
    let request = Request::post("/ik/batch?tool_length=50").header(CONTENT_TYPE, "text/csv");
    let request = request.body(Body::from_stream(pieces)).unwrap();
    let mut body = service.router.clone().oneshot(request).await.unwrap().into_body();
    let mut lines = 0;
    while let Some(frame) = body.frame().await {
        let data = frame.unwrap().into_data().unwrap();
        lines += data.split(|byte| *byte == b'\n').count() - 1;
        // What is read ahead, the piece that is answered, and the answer that was taken.
        let ahead = sent.load(Ordering::Relaxed) * size;
        assert!(ahead.saturating_sub(lines * size / 1000) < LIMIT + (1 << 20), "{ahead} {lines}");
    }
    assert_eq!(lines, total * 1000 + 1);
}

#[tokio::test]
async fn streams_have_permits_of_their_own() {
    let service = service("--max-requests 8").await;
    let stream = open(&service, Format::Csv).await;
    let body = written(Format::Csv, &columns(&NAMES, &poses(2)));
    let (status, _, _) = post(&service, "/ik/batch", "text/csv", body.clone()).await;
    assert_eq!(status, StatusCode::SERVICE_UNAVAILABLE);
    let json = "{\"poses\": [[0, 0, 300, 0, 0]]}";
    let (status, _, _) = post(&service, "/ik/batch", "application/json", json).await;
    assert_eq!(status, StatusCode::OK, "batches in JSON have permits of their own");
    drop(stream);
    let (status, _, _) = post(&service, "/ik/batch", "text/csv", body).await;
    assert_eq!(status, StatusCode::OK);
}
