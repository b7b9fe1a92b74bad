//! What users of `/programs` rely on.

use std::convert::Infallible;
use std::io::Read;

use axum::body::{Body, Bytes};
use axum::http::header::{ACCEPT_ENCODING, CONTENT_ENCODING, CONTENT_TYPE, ETAG, IF_NONE_MATCH, LOCATION};
use axum::http::{HeaderMap, Request, StatusCode};
use flate2::Compression;
use flate2::read::{GzDecoder, GzEncoder};
use futures_util::stream;
use serde_json::{Value, json};

use crate::process::service::Service;
use crate::test_service::{self, service};

const FILE: &str = "UNITS/MM\nLOADTL/3\n$$ a comment\nGOTO/0,0,320\nGOTO/0,0,300\n";

struct Answer {
    status: StatusCode,
    headers: HeaderMap,
    bytes: Bytes,
    json: Value,
}

async fn send(service: &Service, request: Request<Body>) -> Answer {
    let (status, headers, bytes) = test_service::send(service, request).await;
    let json = serde_json::from_slice(&bytes).unwrap_or_default();
    Answer { status, headers, bytes, json }
}

async fn post(service: &Service, query: &str, body: impl Into<Body>) -> Answer {
    send(service, Request::post(format!("/programs?{query}")).body(body.into()).unwrap()).await
}

async fn get(service: &Service, path: &str) -> Answer {
    send(service, Request::get(path).body(Body::empty()).unwrap()).await
}

fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut encoded = Vec::new();
    GzEncoder::new(bytes, Compression::fast()).read_to_end(&mut encoded).unwrap();
    encoded
}

#[tokio::test]
async fn a_program_sent_twice_is_one_object() {
    let service = service("").await;
    let first = post(&service, "format=apt", FILE).await;
    assert_eq!(first.status, StatusCode::CREATED, "{}", first.json);
    let path = first.json["links"]["self"].as_str().unwrap();
    assert_eq!(first.headers[LOCATION], path);
    let counts = ["moves", "events", "lines"].map(|name| first.json[name].as_u64().unwrap());
    assert_eq!(counts, [2, 2, 5]);
    assert_eq!(first.json["tools"], json!([{"number": 3, "length": null, "line": 2}]));
    assert_eq!(first.json["bounds"], json!({"min": [0.0, 0.0, 300.0], "max": [0.0, 0.0, 320.0]}));
    // Bytes that arrive one by one, and those of a compressed body, are the same file.
    let pieces = stream::iter(FILE.bytes().map(|byte| Ok::<_, Infallible>(vec![byte])));
    let second = post(&service, "format=apt", Body::from_stream(pieces)).await;
    let compressed = Request::post("/programs?format=apt").header(CONTENT_ENCODING, "gzip");
    let third = send(&service, compressed.body(gzip(FILE.as_bytes()).into()).unwrap()).await;
    for again in [&second, &third, &get(&service, path).await] {
        assert_eq!((again.status, &again.bytes), (StatusCode::OK, &first.bytes));
    }
    let inches = post(&service, "format=apt&units=inch", FILE).await;
    assert_ne!(inches.json["id"], first.json["id"], "it is read in another way");
}

#[tokio::test]
async fn the_file_is_returned_as_it_was_sent() {
    let service = service("").await;
    // Several pieces, and more than one step of the decoder.
    let rows: Vec<_> = (0..60_000).map(|i| format!("{},{},{}\n", i % 800, i % 7, i % 31)).collect();
    let file = format!("x,y,z\n{}", rows.concat());
    let sent = Request::post("/programs").header(CONTENT_TYPE, "text/csv");
    let answer = send(&service, sent.body(file.clone().into()).unwrap()).await;
    assert_eq!(answer.json["format"], "csv", "{}", answer.json);
    let path = answer.json["links"]["source"].as_str().unwrap();
    let plain = get(&service, path).await;
    assert!(plain.bytes == file, "{} bytes", plain.bytes.len());
    let request = Request::get(path).header(ACCEPT_ENCODING, "gzip").body(Body::empty()).unwrap();
    let compressed = send(&service, request).await;
    assert_eq!(compressed.headers[CONTENT_ENCODING], "gzip");
    let mut decoded = String::new();
    GzDecoder::new(&*compressed.bytes).read_to_string(&mut decoded).unwrap();
    assert!(decoded == file);
    assert_ne!(plain.headers[ETAG], compressed.headers[ETAG]);
    let request = Request::get(path).header(IF_NONE_MATCH, &plain.headers[ETAG]);
    let unmodified = send(&service, request.body(Body::empty()).unwrap()).await;
    assert_eq!(unmodified.status, StatusCode::NOT_MODIFIED);
}

#[tokio::test]
async fn faults_name_line_column_and_word() {
    let service = service("").await;
    let refused = post(&service, "format=apt", "UNITS/MM\nGOTO/0,0\nGOTO/0,0,0\nTHREAD/TURN\n").await;
    assert_eq!(refused.status, StatusCode::UNPROCESSABLE_ENTITY);
    assert_eq!(refused.json["code"], "program_fault");
    let error = &refused.json["errors"][0];
    assert_eq!([&error["line"], &error["column"], &error["word"]], [&json!(2), &json!(1), &json!("GOTO")]);
    assert!(error["detail"].as_str().unwrap().contains("3 or 6 numbers"));
}

#[tokio::test]
async fn bodies_that_are_no_program_are_refused() {
    let limited = service("--max-program-bytes 1000").await;
    let utf16: Vec<u8> = "UNITS/MM\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    let many = vec![b'\n'; 1001];
    for (query, body, status, detail) in [
        ("format=apt", b"\x7FELF\0\0\x01\x02\n".to_vec(), 422, "binary"),
        ("format=apt", utf16, 422, "UTF-16"),
        ("format=apt", gzip(b"UNITS/MM\n"), 422, "compressed"),
        ("format=apt", Vec::new(), 422, "no moves"),
        ("format=apt", b"UNITS/MM\nGOTO/1,2,3\nGOTO/4,5,".to_vec(), 422, "line 3"),
        ("format=apt", many, 413, "1000 bytes"),
        ("format=heidenhain", FILE.into(), 422, "Heidenhain"),
        ("format=step", FILE.into(), 422, "step"),
        ("", FILE.into(), 422, "state format="),
        ("format=apt&units=furlong", FILE.into(), 422, "`inch`"),
        ("format=apt&unit=mm", FILE.into(), 422, "`unit` is unknown"),
        ("format=apt&tcp=true", FILE.into(), 422, "/query/tcp"),
        ("format=apt&tcp_on=M428&tcp_off=M429", FILE.into(), 422, "is for the format gcode"),
        ("format=apt&rapid_feed=5000", FILE.into(), 422, "/query/rapid_feed"),
        ("format=csv&rotary_sense=table", FILE.into(), 422, "in the format csv does not use it"),
        ("format=ndjson&compensation=refuse", FILE.into(), 422, "is for the format apt or gcode"),
    ] {
        let answer = post(&limited, query, body).await;
        assert_eq!(answer.status, status, "{detail}: {}", answer.json);
        assert!(answer.json.to_string().contains(detail), "{detail}: {}", answer.json);
    }
}

#[tokio::test]
async fn the_limit_applies_to_decoded_bytes() {
    let service = service("--max-program-bytes 100000").await;
    let bomb = gzip(&vec![b'\n'; 10_000_000]);
    let request = Request::post("/programs?format=apt").header(CONTENT_ENCODING, "gzip");
    let answer = send(&service, request.body(bomb.into()).unwrap()).await;
    assert_eq!((answer.status.as_u16(), &answer.json["code"]), (413, &json!("body_too_large")));
}

#[tokio::test]
async fn a_body_that_breaks_off_is_refused() {
    let service = service("").await;
    let pieces = [Ok(FILE.as_bytes()), Err(std::io::Error::other("the connection broke off"))];
    let answer = post(&service, "format=apt", Body::from_stream(stream::iter(pieces))).await;
    assert_eq!((answer.status.as_u16(), &answer.json["code"]), (400, &json!("bad_request")));
}

#[tokio::test]
async fn evicted_programs_can_be_sent_again_and_larger_ones_than_the_store_are_refused() {
    let service = service("--cache-bytes 8000").await;
    let rows =
        |count: i32, z: i32| (0..count).map(|i| format!("[{i}, 0, {z}]\n")).collect::<Vec<_>>().concat();
    let refused = post(&service, "format=ndjson", rows(1000, 1)).await;
    assert_eq!((refused.status.as_u16(), &refused.json["code"]), (507, &json!("program_too_large")));
    let first = post(&service, "format=ndjson", rows(50, 1)).await;
    assert_eq!(first.status, StatusCode::CREATED);
    let path = first.json["links"]["self"].as_str().unwrap();
    for z in [2, 3] {
        assert_eq!(post(&service, "format=ndjson", rows(50, z)).await.status, StatusCode::CREATED);
    }
    let evicted = get(&service, &format!("{path}/source")).await;
    assert_eq!((evicted.status.as_u16(), &evicted.json["code"]), (404, &json!("program_not_found")));
    let again = post(&service, "format=ndjson", rows(50, 1)).await;
    assert_eq!((again.status, &again.bytes), (StatusCode::CREATED, &first.bytes));
    let nonsense = get(&service, "/programs/1f2e").await;
    assert_eq!((nonsense.status.as_u16(), &nonsense.json["code"]), (404, &json!("program_not_found")));
}

#[tokio::test]
async fn g_code_is_read_with_the_options_of_the_query() {
    let service = service("").await;
    let file =
        "%\nM428\nT1 M6\nG0 X0 Y0 Z50 A0 C0\nG1 Z5 F9999\nG2 X10 Y0 I5 J0 A30 C90 F800\nM429\nM30\n%\n";
    for codes in ["tcp_on=M428&tcp_off=M429", "tcp_on=[%22M428%22]&tcp_off=M429,M999"] {
        let query = format!("format=gcode&units=mm&rapid_feed=5000&rotary_sense=table&{codes}");
        let answer = post(&service, &query, file).await;
        assert_eq!(
            (answer.status, &answer.json["moves"]),
            (StatusCode::CREATED, &json!(3)),
            "{}",
            answer.json
        );
        assert_eq!(answer.json["warnings"], json!([]));
        assert_eq!(answer.json["bounds"]["max"], json!([10.0, 5.0, 50.0]));
    }
    let refused = post(&service, "format=gcode&units=mm", file).await;
    let error = &refused.json["errors"][0];
    assert_eq!([&error["line"], &error["column"], &error["word"]], [&json!(4), &json!(14), &json!("A0")]);
    assert!(error["detail"].as_str().unwrap().contains("tcp_on"), "{error}");
    for (query, detail) in [
        ("tcp_on=X428", "a code is G or M"),
        ("tcp_on=", "a code is G or M"),
        ("rapid_feed=0", "greater than 0"),
        ("rapid_feed=NaN", "greater than 0"),
        ("rotary_sense=left", "`table`"),
        ("tcp=yes", "true"),
    ] {
        let answer = post(&service, &format!("format=gcode&{query}"), file).await;
        assert_eq!(answer.status, StatusCode::UNPROCESSABLE_ENTITY, "{query}");
        assert!(answer.json.to_string().contains(detail), "{query}: {}", answer.json);
    }
}
