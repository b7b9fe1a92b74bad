//! `/programs`: files that no reader can use are refused with a document that says why, in bounded memory.

use axum::Router;
use axum::body::Body;
use axum::http::{Method, Request, header};
use futures_util::stream;
use serde_json::json;

use super::{Reply, get_from, send_to, service};

const FILE: &str = "UNITS/MM\nGOTO/0,0,320\nGOTO/0,0,300\n";

async fn send(service: &Router, query: &str, body: impl Into<Body>) -> Reply {
    let request = Request::post(format!("/programs?{query}")).body(body.into()).unwrap();
    send_to(service.clone(), request).await
}

/// A body of many equal pieces, which is never in memory as a whole.
fn repeated(piece: &'static [u8], count: usize) -> Body {
    Body::from_stream(stream::iter((0..count).map(move |_| Ok::<_, std::convert::Infallible>(piece))))
}

#[tokio::test]
async fn a_form_of_curl_is_a_program_if_the_format_is_stated() {
    let service = service().await;
    let request = Request::builder()
        .method(Method::POST)
        .uri("/programs?format=apt")
        .header(header::CONTENT_TYPE, "application/x-www-form-urlencoded");
    let reply = send_to(service.clone(), request.body(FILE.into()).unwrap()).await;
    assert_eq!((reply.status.as_u16(), &reply.json["moves"]), (201, &json!(2)));
    let location = reply.headers[header::LOCATION].to_str().unwrap();
    let stored = get_from(&service, location, &[]).await;
    assert_eq!(stored.bytes, reply.bytes);
    assert_eq!(get_from(&service, &format!("{location}/source"), &[]).await.bytes, FILE.as_bytes());
}

#[tokio::test]
async fn what_is_no_program_is_refused_with_its_line() {
    let service = service().await;
    let utf16: Vec<u8> = FILE.encode_utf16().flat_map(u16::to_be_bytes).collect();
    for (body, line, part) in [
        (repeated(b"\n\n\n\n\n\n\n\n", 100_000), 1, "no moves"),
        (repeated(&[b'G'; 1 << 12], 960), 1, "longer than"),
        (utf16.into(), 1, "UTF-16"),
        (vec![0_u8, 1, 2, 3].into(), 1, "binary"),
        ("UNITS/MM\nGOTO/0,0,0\nGOTO/1,".into(), 3, "3 or 6 numbers"),
    ] {
        let reply = send(&service, "format=apt", body).await;
        reply.assert_problem(422, "program_fault");
        let error = &reply.json["errors"][0];
        assert_eq!(error["line"], line, "{error}");
        assert!(error["detail"].as_str().unwrap().contains(part), "{error}");
    }
}

#[tokio::test]
async fn a_program_beyond_the_limit_is_refused_while_it_arrives() {
    let reply = send(&service().await, "format=apt", repeated(b"$$ a comment\n", 1_000_000)).await;
    reply.assert_problem(413, "body_too_large");
}

#[tokio::test]
async fn other_controllers_and_unknown_formats_are_refused_by_name() {
    let service = service().await;
    for (query, part) in [("format=siemens", "Siemens"), ("format=dxf", "dxf"), ("units=mm", "format=")] {
        let reply = send(&service, query, FILE).await;
        reply.assert_bad_field("/query/format");
        assert!(reply.json["detail"].as_str().unwrap().contains(part), "{}", reply.json);
    }
}
