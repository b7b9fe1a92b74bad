//! Bodies that are compressed, begin with a byte order mark, or are not JSON.

use std::io::Write;

use axum::body::Body;
use axum::http::{Method, Request, header};
use flate2::Compression;
use flate2::write::GzEncoder;
use serde_json::json;

use super::{Reply, json_request, post, send};

const QUESTION: &str = r#"{"joints": {"rho": [674, 685, 250]}}"#;

fn gzipped(text: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(text).unwrap();
    encoder.finish().unwrap()
}

fn brotlied(mut text: &[u8]) -> Vec<u8> {
    let mut encoded = Vec::new();
    brotli::BrotliCompress(&mut text, &mut encoded, &brotli::enc::BrotliEncoderParams::default()).unwrap();
    encoded
}

async fn encoded(path: &str, coding: &str, body: Vec<u8>) -> Reply {
    let mut request = json_request(Method::POST, path, "");
    request.headers_mut().insert(header::CONTENT_ENCODING, coding.parse().unwrap());
    *request.body_mut() = Body::from(body);
    send(request).await
}

#[tokio::test]
async fn an_encoded_body_is_answered_like_a_plain_one() {
    let rows = json!({"frame": "platform", "poses": vec![[0, 0, 1200]; 1000]}).to_string();
    let points = json!({"points": [[0, 0, 1200], null]}).to_string();
    for (path, question) in [("/fk", QUESTION), ("/ik/batch", &rows), ("/workspace/contains", &points)] {
        let plain = post(path, question).await;
        for (coding, body) in [
            ("gzip", gzipped(question.as_bytes())),
            ("br", brotlied(question.as_bytes())),
            ("identity", question.into()),
        ] {
            let reply = encoded(path, coding, body).await;
            assert_eq!((reply.status, &reply.json), (plain.status, &plain.json), "{path} {coding}");
        }
    }
}

#[tokio::test]
async fn the_limit_counts_decoded_bytes() {
    for (path, limit) in [("/fk", 64 * 1024), ("/fk/batch", 1024 * 1024)] {
        let large = vec![b' '; limit + 1];
        for (coding, body) in [("gzip", gzipped(&large)), ("br", brotlied(&large))] {
            assert!(body.len() < limit / 100, "the body as sent is small");
            let reply = encoded(path, coding, body).await;
            reply.assert_problem(413, "body_too_large");
            assert!(reply.json["detail"].as_str().unwrap().contains(&limit.to_string()));
        }
    }
}

#[tokio::test]
async fn an_undecodable_body_is_refused() {
    for coding in ["zstd", "deflate", "gzip, br"] {
        let reply = encoded("/fk", coding, QUESTION.into()).await;
        reply.assert_problem(415, "unsupported_coding");
        assert_eq!(reply.headers[header::ACCEPT_ENCODING], "gzip, br");
    }
    let mut cut = gzipped(QUESTION.as_bytes());
    cut.truncate(cut.len() / 2);
    let two = [gzipped(QUESTION.as_bytes()), gzipped(b" ")].concat();
    for (coding, body) in [("gzip", cut), ("gzip", two), ("gzip", QUESTION.into()), ("br", vec![0xFF; 9])] {
        for path in ["/fk", "/fk/batch"] {
            encoded(path, coding, body.clone()).await.assert_problem(400, "bad_request");
        }
    }
}

#[tokio::test]
async fn a_byte_order_mark_is_skipped() {
    assert_eq!(post("/fk", format!("\u{FEFF}{QUESTION}")).await.json, post("/fk", QUESTION).await.json);
    let batch = "\u{FEFF}{\"joints\": [[674, 685, 250]]}";
    assert_eq!(post("/fk/batch", batch).await.json["status"], json!(["ok"]));
    post("/fk", "\u{FEFF}{}").await.assert_bad_field("/joints");
}

#[tokio::test]
async fn a_syntax_error_shows_the_received_text() {
    for (body, shown) in [
        ("'{joints: [1]}'", "begins with \"'{joints: [1]}'\"."),
        ("\u{FF}\n\0", "begins with \"\\xc3\\xbf\\n\\x00\"."),
        ("", "the body is empty."),
    ] {
        let reply = post("/fk", body).await;
        reply.assert_problem(400, "bad_json");
        let detail = reply.json["detail"].as_str().unwrap();
        assert!(detail.ends_with(shown), "{detail}");
    }
    let long = post("/fk", "x".repeat(60_000)).await;
    assert!(long.json["detail"].as_str().unwrap().len() < 500, "what is shown is bounded");
}

#[tokio::test]
async fn a_body_without_json_content_type_gets_advice_for_curl() {
    let form = Request::post("/fk").header(header::CONTENT_TYPE, "application/x-www-form-urlencoded");
    for request in [Request::post("/fk"), form] {
        let reply = send(request.body(Body::from(QUESTION)).unwrap()).await;
        reply.assert_problem(415, "unsupported_media_type");
        assert!(reply.json["detail"].as_str().unwrap().contains("curl --json"), "{}", reply.json);
    }
}
