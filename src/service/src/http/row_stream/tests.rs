//! Batches in columns give what batches in JSON give, while their rows arrive, in bounded memory.

mod pipes;
mod streaming;

use axum::body::{Body, Bytes};
use axum::http::header::{ACCEPT, CONTENT_ENCODING, CONTENT_TYPE};
use axum::http::{HeaderMap, Request, StatusCode};
use serde_json::{Map, Value, json};
use verne_rows::{Column, Format, Reader, Writer};

use crate::process::service::Service;
use crate::test_service::{send, service};

/// The poses of the tests: reachable, infeasible, unreachable.
pub(super) fn poses(count: u32) -> Vec<[f64; 5]> {
    let pose = |i: u32| {
        let t = f64::from(i);
        let z = if i % 7 == 3 { 2000.0 } else { 250.0 + (t * 0.37) % 90.0 };
        [
            (t * 7.3) % 300.0 - 150.0,
            (t * 3.1) % 200.0 - 100.0,
            z,
            (t * 1.7) % 25.0,
            (t * 11.0) % 360.0 - 180.0,
        ]
    };
    (0..count).map(pose).collect()
}

pub(super) fn columns(names: &[&str], rows: &[[f64; 5]]) -> Vec<Column> {
    let column = |(i, name): (usize, &&str)| Column::numbers(name, rows.iter().map(move |row| Some(row[i])));
    let mut columns: Vec<_> = names.iter().enumerate().map(column).collect();
    columns.reverse();
    columns.insert(2, Column::texts("id", (0..rows.len()).map(|i| Some(format!("row {i}")))));
    columns
}

pub(super) fn written(format: Format, columns: &[Column]) -> Vec<u8> {
    let mut writer = Writer::new(format, columns).unwrap();
    let mut bytes = writer.write(columns).unwrap();
    bytes.extend(writer.finish().unwrap());
    bytes
}

/// Rows as objects of JSON.
pub(super) fn objects(format: Format, bytes: &[u8]) -> Vec<Map<String, Value>> {
    let mut reader = Reader::new(format, &[], 1 << 30);
    reader.push(bytes);
    reader.end();
    let mut text = Vec::new();
    let mut writer = None;
    while let Some(chunk) = reader.next_chunk().unwrap() {
        let writer = writer.get_or_insert_with(|| Writer::new(Format::Ndjson, chunk.columns()).unwrap());
        text.extend(writer.write(chunk.columns()).unwrap());
    }
    text.split(|byte| *byte == b'\n')
        .filter(|line| !line.is_empty())
        .map(|line| serde_json::from_slice(line).unwrap())
        .collect()
}

pub(super) async fn post(
    service: &Service,
    path: &str,
    media: &str,
    body: impl Into<Body>,
) -> (StatusCode, HeaderMap, Bytes) {
    let request = Request::post(path).header(CONTENT_TYPE, media).body(body.into());
    send(service, request.unwrap()).await
}

async fn post_json(service: &Service, path: &str, body: Value) -> Value {
    let (status, _, answer) = post(service, path, "application/json", body.to_string()).await;
    assert_eq!(status, StatusCode::OK);
    serde_json::from_slice(&answer).unwrap()
}

/// A number of JSON, or the text of a number in CSV; nothing for a missing value.
fn number(value: &Value) -> Option<f64> {
    value.as_f64().or_else(|| value.as_str().filter(|text| !text.is_empty())?.parse().ok())
}

/// Compares a column of rows with a list of JSON.
fn assert_column(rows: &[Map<String, Value>], name: &str, expected: impl Fn(usize) -> Value, context: &str) {
    for (i, row) in rows.iter().enumerate() {
        let (found, expected) = (&row[name], expected(i));
        let equal = match &expected {
            Value::Number(_) => number(found) == expected.as_f64(),
            Value::Null => found.is_null() || found == "",
            Value::Bool(flag) => found == flag || found == if *flag { "true" } else { "false" },
            other => found == other,
        };
        assert!(equal, "{context}, row {i}, {name}: {found} instead of {expected}");
    }
}

#[tokio::test]
async fn inverse_rows_are_the_same_in_every_format() {
    let service = service("").await;
    let poses = poses(9000);
    for continuous in [false, true] {
        let body = json!({"tool_length": 50, "poses": poses, "continuous": continuous});
        let expected = post_json(&service, "/ik/batch", body).await;
        for from in Format::ALL {
            let body = written(from, &columns(&["x", "y", "z", "phi1", "phi2"], &poses));
            for to in Format::ALL {
                let query = format!("tool_length=50&continuous={continuous}&format={}", to.name());
                let path = format!("/ik/batch?{query}");
                let (status, headers, answer) = post(&service, &path, from.media(), body.clone()).await;
                assert_eq!((status, headers[CONTENT_TYPE].to_str().ok()), (StatusCode::OK, Some(to.media())));
                assert_eq!(headers["machine-hash"].to_str().ok(), expected["machine"]["hash"].as_str());
                let rows = objects(to, &answer);
                assert_eq!(rows.len(), poses.len());
                assert_eq!(rows[0].keys().next().map(String::as_str), Some("id"), "passed on, and first");
                let context = format!("{from:?} to {to:?}");
                assert_column(&rows, "id", |i| json!(format!("row {i}")), &context);
                for (k, name) in ["rho1", "rho2", "rho3", "theta1", "theta2"].into_iter().enumerate() {
                    assert_column(&rows, name, |i| expected["joints"][i][k].clone(), &context);
                }
                for name in ["status", "constraint", "margin", "element"] {
                    assert_column(&rows, name, |i| expected[name][i].clone(), &context);
                }
                assert_eq!(rows[0].contains_key("jump"), continuous);
                if continuous {
                    assert_column(&rows, "jump", |i| expected["jump"][i].clone(), &context);
                }
            }
        }
    }
}

#[tokio::test]
async fn forward_rows_and_points_are_the_same_as_in_json() {
    let service = service("").await;
    let joints: Vec<_> = (0..50).map(|i| [674.0 + f64::from(i), 685.0, 250.0, 10.0, f64::from(i)]).collect();
    let body = json!({"tool_length": 50, "joints": joints, "orientation": "vector"});
    let expected = post_json(&service, "/fk/batch", body).await;
    let names = ["rho1", "rho2", "rho3", "theta1", "theta2"];
    let body = written(Format::Arrow, &columns(&names, &joints));
    let path = "/fk/batch?tool_length=50&orientation=vector";
    let (status, _, answer) = post(&service, path, Format::Arrow.media(), body).await;
    assert_eq!(status, StatusCode::OK);
    let rows = objects(Format::Arrow, &answer);
    for (k, name) in ["platform_x", "platform_y", "platform_z", "alpha"].into_iter().enumerate() {
        assert_column(&rows, name, |i| expected["poses"][i][k].clone(), "fk");
    }
    for (k, name) in ["x", "y", "z", "i", "j", "k"].into_iter().enumerate() {
        assert_column(&rows, name, |i| expected["parts"][i][k].clone(), "fk");
    }
    let points: Vec<_> = poses(50).into_iter().map(|[x, y, z, ..]| [x, y, z]).collect();
    let body = json!({"kind": "part", "tool_length": 50, "points": points});
    let expected = post_json(&service, "/workspace/contains", body).await;
    let points: Vec<_> = points.iter().map(|[x, y, z]| format!("{z},{x},{y}")).collect();
    let csv = format!("z,x,y\n{}\n", points.join("\n"));
    let path = "/workspace/contains?kind=part&tool_length=50";
    let (status, _, answer) = post(&service, path, "text/csv", csv).await;
    assert_eq!(status, StatusCode::OK);
    let rows = objects(Format::Csv, &answer);
    for name in ["inside", "margin", "unit", "constraint", "element"] {
        assert_column(&rows, name, |i| expected[name][i].clone(), "contains");
    }
}

#[tokio::test]
async fn a_row_that_cannot_be_used_affects_no_other() {
    let service = service("").await;
    let csv = "x,y,z,i,j,k,n\n0,0,300,0,0,1,a\n,0,300,0,0,1,b\n0,NaN,300,0,0,1,c\n1e9,0,300,0,0,1,d\n\
        0,0,300,0,0,0,e\n0,0,300,0,0,1\n0,0,300,0,0,1,g\n";
    let (status, _, answer) = post(&service, "/ik/batch?tool_length=50", "text/csv", csv).await;
    assert_eq!(status, StatusCode::OK);
    let rows = objects(Format::Csv, &answer);
    let statuses: Vec<_> = rows.iter().map(|row| row["status"].as_str().unwrap()).collect();
    assert_eq!(statuses, ["ok", "invalid", "invalid", "invalid", "invalid", "invalid", "ok"]);
    for (row, detail) in [(1, "x is not"), (2, "y is not"), (3, "x must be"), (4, "axis"), (5, "6 values")] {
        assert!(rows[row]["detail"].as_str().unwrap().contains(detail), "{:?}", rows[row]);
    }
    assert_eq!(rows[0]["rho1"], rows[6]["rho1"]);
}

#[tokio::test]
async fn an_error_before_the_first_row_is_a_problem() {
    let service = service("").await;
    let csv = "text/csv";
    for (path, media, body, status, code, pointer) in [
        ("/ik/batch", csv, "x,y\n1,2\n", 422, "invalid_request", Some("/columns/z")),
        ("/ik/batch", csv, "x,y,z\n1,2,3\n", 422, "invalid_request", Some("/columns/phi1")),
        ("/ik/batch", csv, "x,y,z,i,j\n1,2,3,0,0\n", 422, "invalid_request", Some("/columns/k")),
        ("/ik/batch", csv, "x,y,z,phi1,phi2,k\n", 422, "invalid_request", Some("/columns/k")),
        ("/ik/batch?frame=tool", csv, "x,y,z,phi1\n", 422, "invalid_request", Some("/columns/phi1")),
        ("/ik/batch", csv, "x,y,z,phi1,phi2,x\n", 422, "invalid_request", Some("/columns/x")),
        ("/ik/batch?tool_length=-1", csv, "", 422, "invalid_request", Some("/query/tool_length")),
        ("/ik/batch?machine=nautilus", csv, "", 422, "invalid_request", Some("/query/machine")),
        ("/ik/batch?start={}", csv, "", 422, "invalid_request", Some("/query/start")),
        ("/ik/batch?solutions=all", csv, "", 422, "invalid_request", Some("/query/solutions")),
        ("/ik/batch?format=json", csv, "", 422, "invalid_request", Some("/query/format")),
        ("/ik/batch?format=csv", "application/json", "{}", 422, "invalid_request", Some("/query/format")),
        ("/ik/batch?frame=tool", "application/json", "{}", 422, "invalid_request", Some("/query/frame")),
        (
            "/fk/batch?table_clearance=1",
            csv,
            "rho1,rho2,rho3\n",
            422,
            "invalid_request",
            Some("/columns/theta1"),
        ),
        ("/fk/batch", csv, "rho1,rho2,rho3,theta1\n", 422, "invalid_request", Some("/columns/theta2")),
        ("/ik/batch", csv, "1,2,3\n", 422, "bad_rows", None),
        ("/ik/batch", Format::Arrow.media(), "x,y,z\n", 422, "bad_rows", None),
        ("/ik/batch", Format::Ndjson.media(), "nonsense", 422, "bad_rows", None),
        ("/ik/batch", "text/plain", "x,y,z\n", 415, "unsupported_media_type", None),
    ] {
        let (found, _, problem) = post(&service, path, media, body).await;
        let problem: Value = serde_json::from_slice(&problem).unwrap();
        assert_eq!(
            (found.as_u16(), problem["code"].as_str()),
            (status, Some(code)),
            "{path} {body} {problem}"
        );
        assert_eq!(problem["errors"][0]["pointer"].as_str(), pointer, "{path} {body} {problem}");
    }
}

#[tokio::test]
async fn headers_and_the_query_choose_the_formats() {
    let service = service("").await;
    let body = "x,y,z,phi1,phi2\n0,0,300,0,0\n";
    for (path, media, accept, expected) in [
        ("/ik/batch", "text/csv; charset=utf-8", "*/*", Some(Format::Csv)),
        ("/ik/batch", "text/csv", "application/vnd.apache.arrow.stream", Some(Format::Arrow)),
        ("/ik/batch", "text/csv", "application/x-ndjson, text/csv;q=0.5", Some(Format::Ndjson)),
        ("/ik/batch?format=csv", "application/x-www-form-urlencoded", "*/*", Some(Format::Csv)),
        ("/ik/batch?format=arrow", "text/csv", "text/csv", Some(Format::Arrow)),
        ("/ik/batch", "text/csv", "application/json", None),
    ] {
        let request = Request::post(path).header(CONTENT_TYPE, media).header(ACCEPT, accept);
        let (status, headers, answer) = send(&service, request.body(body.into()).unwrap()).await;
        match expected {
            Some(format) => {
                assert_eq!(status, StatusCode::OK, "{accept}");
                assert_eq!(headers[CONTENT_TYPE], format.media(), "{accept}");
                assert_eq!(objects(format, &answer)[0]["status"], "ok", "{accept}");
            }
            None => assert_eq!(status, StatusCode::NOT_ACCEPTABLE),
        }
    }
}

#[tokio::test]
async fn the_examples_of_tables_are_answers() {
    let service = service("").await;
    let document = crate::document();
    for path in ["/ik/batch.csv", "/fk/batch.csv", "/workspace/contains.csv"] {
        let operation = &document["paths"][path]["post"];
        let request = operation["requestBody"]["content"]["text/csv"]["example"].as_str().unwrap();
        let (status, _, answer) = post(&service, path, "text/csv", request.to_owned()).await;
        let expected = operation["responses"]["200"]["content"]["text/csv"]["example"].as_str().unwrap();
        assert_eq!((status, str::from_utf8(&answer).unwrap()), (StatusCode::OK, expected));
    }
}

#[tokio::test]
async fn compressed_rows_are_decoded_while_they_arrive() {
    let service = service("").await;
    let body = written(Format::Csv, &columns(&["x", "y", "z", "phi1", "phi2"], &poses(3000)));
    let (_, _, expected) = post(&service, "/ik/batch", "text/csv", body.clone()).await;
    let mut gzip = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    std::io::Write::write_all(&mut gzip, &body).unwrap();
    let request =
        Request::post("/ik/batch").header(CONTENT_TYPE, "text/csv").header(CONTENT_ENCODING, "gzip");
    let (status, _, answer) = send(&service, request.body(gzip.finish().unwrap().into()).unwrap()).await;
    assert!(status == StatusCode::OK && answer == expected);
}
