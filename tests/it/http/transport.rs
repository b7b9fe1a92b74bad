//! Properties of all answers: compression, ids, caching, HEAD, probes.

use axum::body::Body;
use axum::http::{HeaderValue, Method, Request, StatusCode, header};
use serde_json::json;

use super::{get, get_from, json_request, post, send, service};

const QUESTION: &str = "/ik?frame=platform&x=-240&y=-86&z=1000&solutions=all";

#[tokio::test]
async fn answers_are_compressed_on_request() {
    let plain = get(QUESTION).await;
    assert!(!plain.headers.contains_key(header::CONTENT_ENCODING));
    for encoding in ["gzip", "br", "zstd"] {
        let request =
            Request::get(QUESTION).header(header::ACCEPT_ENCODING, encoding).body(Body::empty()).unwrap();
        let reply = send(request).await;
        assert_eq!(reply.headers[header::CONTENT_ENCODING], encoding);
        assert!(reply.bytes.len() * 2 < plain.bytes.len(), "{encoding}: {}", reply.bytes.len());
    }
}

#[tokio::test]
async fn a_client_that_refuses_every_encoding_gets_406() {
    for uri in [QUESTION, "/fk?rho=x"] {
        let request =
            Request::get(uri).header(header::ACCEPT_ENCODING, "identity;q=0").body(Body::empty()).unwrap();
        let reply = send(request).await;
        reply.assert_problem(406, "not_acceptable");
        assert!(!reply.headers.contains_key(header::CACHE_CONTROL), "{:?}", reply.headers);
    }
}

#[tokio::test]
async fn static_answers_have_an_etag_for_each_encoding() {
    let service = service().await;
    let plain = get_from(&service, "/openapi.json", &[]).await;
    assert!(!plain.headers.contains_key(header::CONTENT_ENCODING));
    let mut tags = vec![plain.headers[header::ETAG].clone()];
    for encoding in ["gzip", "br"] {
        let accepted = (header::ACCEPT_ENCODING, encoding);
        let reply = get_from(&service, "/openapi.json", std::slice::from_ref(&accepted)).await;
        assert_eq!(reply.headers[header::CONTENT_ENCODING], encoding);
        assert_eq!(reply.headers[header::VARY], "accept-encoding");
        assert!(reply.bytes.len() * 4 < plain.bytes.len(), "{encoding}: {}", reply.bytes.len());
        let tag = reply.headers[header::ETAG].clone();
        let known = [accepted, (header::IF_NONE_MATCH, tag.to_str().unwrap())];
        let again = get_from(&service, "/openapi.json", &known).await;
        assert_eq!((again.status, again.bytes.len()), (StatusCode::NOT_MODIFIED, 0));
        tags.push(tag);
    }
    assert!(tags[0] != tags[1] && tags[1] != tags[2] && tags[2] != tags[0], "{tags:?}");
}

#[tokio::test]
async fn large_answers_are_sent_uncompressed() {
    let poses = vec![[0.0, 0.0, 1200.0]; 2_000];
    let body = json!({"frame": "platform", "poses": poses});
    let plain = post("/ik/batch", &body).await;
    assert!(plain.bytes.len() > 64 * 1024);
    let mut request = json_request(Method::POST, "/ik/batch", &body);
    request.headers_mut().insert(header::ACCEPT_ENCODING, HeaderValue::from_static("br, gzip, zstd"));
    let reply = send(request).await;
    assert!(!reply.headers.contains_key(header::CONTENT_ENCODING));
    assert_eq!(reply.bytes, plain.bytes);
}

#[tokio::test]
async fn every_request_has_an_id() {
    let ids = [get(QUESTION).await, get("/nowhere").await].map(|reply| reply.headers["x-request-id"].clone());
    assert_ne!(ids[0], ids[1]);
    let mine = Request::get(QUESTION).header("x-request-id", "mine").body(Body::empty()).unwrap();
    assert_eq!(send(mine).await.headers["x-request-id"], "mine");
    let long = Request::get(QUESTION).header("x-request-id", "x".repeat(129)).body(Body::empty()).unwrap();
    assert!(send(long).await.headers["x-request-id"].len() < 129, "it would stand in every line of the log");
}

#[tokio::test]
async fn get_answers_are_cacheable() {
    assert!(get(QUESTION).await.headers[header::CACHE_CONTROL].to_str().unwrap().contains("max-age"));
    assert!(!get("/fk?rho=x").await.headers.contains_key(header::CACHE_CONTROL));
}

#[tokio::test]
async fn head_answers_without_a_body() {
    let head = Request::head(QUESTION).body(Body::empty()).unwrap();
    let reply = send(head).await;
    assert_eq!((reply.status, reply.bytes.len()), (StatusCode::OK, 0));
}

#[tokio::test]
async fn probes_and_docs_are_answered() {
    for probe in ["/livez", "/readyz"] {
        assert_eq!(get(probe).await.json["status"], "ok");
    }
    let page = get("/docs/").await;
    assert_eq!(page.status, StatusCode::OK);
    assert!(page.headers[header::CONTENT_TYPE].to_str().unwrap().starts_with("text/html"));
    let text = String::from_utf8(page.bytes).unwrap();
    assert!(!text.contains("https://"), "the page loads nothing from elsewhere");
    let script = get("/docs/swagger-initializer.js").await;
    assert!(String::from_utf8(script.bytes).unwrap().contains("/openapi.json"));
}
