//! What users of `/toolpath` rely on.

use axum::body::Body;
use axum::http::header::{CONTENT_TYPE, LOCATION};
use axum::http::{HeaderMap, Request, StatusCode};
use serde_json::{Value, json};

use crate::operations::toolpath_rows::row_bytes::StoredRow;
use crate::operations::toolpath_rows::{chunk_count, chunk_name, read_chunk};
use crate::process::service::Service;
use crate::test_service;

mod failures;
mod limits;
mod semantics;
mod time;

const JSON: &str = "application/json";
const FORM: &str = "application/x-www-form-urlencoded";

/// A level line of 300 mm over the table.
const LINE: &str = "UNITS/MM\nRAPID\nGOTO/-150,0,300\nFEDRAT/1000,MMPM\nGOTO/150,0,300\nFINI\n";

async fn service() -> Service {
    test_service::service("").await
}

async fn send(service: &Service, request: Request<Body>) -> (StatusCode, HeaderMap, Value) {
    let (status, headers, bytes) = test_service::send(service, request).await;
    (status, headers, serde_json::from_slice(&bytes).unwrap_or_default())
}

async fn post(service: &Service, path: &str, media: &str, body: impl Into<Body>) -> (StatusCode, Value) {
    let request = Request::post(path).header(CONTENT_TYPE, media).body(body.into()).unwrap();
    let (status, _, json) = send(service, request).await;
    (status, json)
}

async fn plan(service: &Service, request: &Value) -> Value {
    let (status, report) = post(service, "/toolpath", JSON, request.to_string()).await;
    assert_eq!(status, StatusCode::OK, "{report}");
    report
}

async fn get(service: &Service, path: &str) -> (StatusCode, Value) {
    let (status, _, json) = send(service, Request::get(path).body(Body::empty()).unwrap()).await;
    (status, json)
}

async fn rows_of(service: &Service, report: &Value) -> Vec<StoredRow> {
    let id = report["id"].as_str().unwrap().parse().unwrap();
    let mut rows = Vec::new();
    for chunk in 0..chunk_count(report["rows"].as_u64().unwrap()) {
        let chunk = service.state.results.blob(id, &chunk_name(chunk)).await.unwrap();
        rows.extend(read_chunk(&chunk.bytes).map(Result::unwrap));
    }
    rows
}

#[tokio::test]
async fn a_file_becomes_rows_and_a_report() {
    let service = service().await;
    let path = "/toolpath?format=apt&tool_length=100&tip_tolerance=0.01";
    let (status, report) = post(&service, path, FORM, LINE).await;
    assert_eq!(status, StatusCode::OK, "{report}");
    assert_eq!((&report["verdict"], &report["failures"]), (&json!("ok"), &json!([])));
    assert!(report["deviation"]["tip"].as_f64().unwrap() <= 0.01, "{report}");
    assert_eq!(report["length"], json!({"feed": 300.0, "rapid": 0.0}));
    // A single segment would bend the line by 17 mm; the longest steps need 43.
    let count = report["rows"].as_u64().unwrap();
    assert!((44..=57).contains(&count), "{count}");
    let rows = rows_of(&service, &report).await;
    assert_eq!(rows.len() as u64, count);
    assert_eq!((rows[0].line, rows[0].position.tip), (3, [-150.0, 0.0, 300.0]));
    let last = rows.last().unwrap();
    assert_eq!((last.line, last.position.tip), (5, [150.0, 0.0, 300.0]));
    let (status, again) = get(&service, report["links"]["self"].as_str().unwrap()).await;
    assert_eq!((status, again), (StatusCode::OK, report));
}

#[tokio::test]
async fn equal_requests_have_equal_ids_in_every_form() {
    let service = service().await;
    let points = json!([[0, 0, 300, 0, 0, 1], [20, 0, 300, 0, 0, 1]]);
    let rows = "[0.0,0.0,300.0,0.0,0.0,1.0]\n[20.0,0.0,300.0,0.0,0.0,1.0]\n";
    let of_points = plan(&service, &json!({"program": {"points": points}, "tool_length": 50})).await;
    let (_, program) = post(&service, "/programs?format=ndjson", FORM, rows).await;
    assert_eq!(program["id"], of_points["program"], "{program}");
    let stated = json!({"program": program["id"], "machine": "verne", "tool_length": 50.0, "tip": "end",
        "setup": {"z": -0.0}, "offsets": {}, "pole": 0.025, "tool_radius": 7, "start": null, "on_limit": "fail",
        "tolerance": {"axis": 0.05, "tip": 1e-2}, "rapids": "linear", "orientation": null});
    assert_eq!(plan(&service, &stated).await["id"], of_points["id"]);
    let query = "/toolpath?tool_length=50&format=ndjson&setup={%22x%22:0}&axis_tolerance=0.05";
    let (status, of_file) = post(&service, query, "text/plain", rows).await;
    assert_eq!((status, &of_file["id"]), (StatusCode::OK, &of_points["id"]), "{of_file}");
    for other in [json!({"tool_length": 51}), json!({"setup": {"c": 1}}), json!({"tolerance": {"tip": 0.02}})]
    {
        let mut request = json!({"program": program["id"], "tool_length": 50});
        request.as_object_mut().unwrap().extend(other.as_object().unwrap().clone());
        assert_ne!(plan(&service, &request).await["id"], of_points["id"], "{request}");
    }
}

#[tokio::test]
async fn faults_of_a_program_name_their_line_before_a_job_is_made() {
    let service = service().await;
    let file = "UNITS/MM\nGOTO/0,0,320\nLOADTL/2\nGOTO/0,0,300\n";
    let refused = |query: &str, line: u32, word: &str| {
        let (path, word) = (format!("/toolpath?format=apt&{query}"), word.to_owned());
        let service = &service;
        async move {
            let (status, problem) = post(service, &path, FORM, file).await;
            assert_eq!(
                (status, &problem["code"]),
                (StatusCode::UNPROCESSABLE_ENTITY, &json!("program_fault"))
            );
            let fault = &problem["errors"][0];
            assert_eq!((&fault["line"], &fault["word"]), (&json!(line), &json!(word)), "{problem}");
        }
    };
    refused("tool_length={%222%22:90}", 2, "").await;
    refused("tool_length={%221%22:90}&length_before=1", 3, "LOADTL/2").await;
    refused("", 2, "").await;
    refused("tool_length=90&orientation=rotary", 2, "").await;
    let opposite = json!({"program": {"points": [[0, 0, 300, 90, 0], [9, 0, 300, -90, 0]]}, "tool_length": 50,
        "orientation": "vector"});
    let (_, problem) = post(&service, "/toolpath", JSON, opposite.to_string()).await;
    assert_eq!((&problem["code"], &problem["errors"][0]["line"]), (&json!("program_fault"), &json!(2)));
    let (_, jobs) = get(&service, "/jobs").await;
    assert_eq!(jobs["jobs"], json!([]));
}

#[tokio::test]
async fn fields_that_cannot_be_used_are_named() {
    let service = service().await;
    let request = json!({"program": {"points": [[0, 0, 300]]}, "tool_length": {"1": -5}, "length_before": 2,
        "setup": {"x": 1e9, "c": 1e9}, "offsets": {"G60": {}, "G54": {}}, "tolerance": {"tip": 0, "rapid": 1e4},
        "pole": 1, "table_clearance": -1, "start": {"rho": [500, 1e9, 500], "theta1": 1e9, "theta2": 0}});
    let (status, problem) = post(&service, "/toolpath", JSON, request.to_string()).await;
    assert_eq!(status, StatusCode::UNPROCESSABLE_ENTITY);
    let mut named: Vec<&str> = problem["errors"]
        .as_array()
        .unwrap()
        .iter()
        .map(|error| error["pointer"].as_str().unwrap())
        .collect();
    named.sort_unstable();
    assert_eq!(
        named,
        [
            "/length_before",
            "/offsets/G54",
            "/offsets/G60",
            "/pole",
            "/setup/c",
            "/setup/x",
            "/start/rho/1",
            "/start/theta1",
            "/table_clearance",
            "/tolerance/rapid",
            "/tolerance/tip",
            "/tool_length/1",
        ]
    );
    let (_, problem) =
        post(&service, "/toolpath?format=apt&tip_tolerance=0&setup={%22y%22:1e9}", FORM, LINE).await;
    let named = |problem: &Value, i: usize| problem["errors"][i]["pointer"].clone();
    assert_eq!(
        [named(&problem, 0), named(&problem, 1)],
        ["/query/setup/y", "/query/tip_tolerance"],
        "{problem}"
    );
    for (path, media, body, pointer) in [
        ("/toolpath", JSON, "{}", "/program"),
        ("/toolpath", JSON, r#"{"program": "x"}"#, "/program"),
        ("/toolpath", JSON, r#"{"program": {"points": [[1, 2]]}}"#, "/program/points/0"),
        (
            "/toolpath",
            JSON,
            r#"{"program": {"points": [[1, 2, 3], {"x": 1, "y": 2, "z": 3, "Phi1": 20}]}}"#,
            "/program/points/1/Phi1",
        ),
        ("/toolpath", JSON, r#"{"program": {"points": [[1, 2, 3]]}, "setup": [1]}"#, "/setup"),
        ("/toolpath?tool_length=5", JSON, "{}", "/query/tool_length"),
        ("/toolpath?format=apt&start={%22theta1%22:1}", FORM, LINE, "/query/start"),
        ("/toolpath?format=step", FORM, LINE, "/query/format"),
        ("/toolpath", FORM, LINE, "/query/format"),
    ] {
        let (status, problem) = post(&service, path, media, body).await;
        assert_eq!(status, StatusCode::UNPROCESSABLE_ENTITY, "{path} {problem}");
        assert_eq!(named(&problem, 0), pointer, "{path} {problem}");
    }
}

#[tokio::test]
async fn points_state_their_orientations_in_their_own_ways() {
    let service = service().await;
    let points = json!([[0, 0, 300], [10, 0, 300, 10, 30], [20, 0, 300, 0, -0.1, 1],
        {"x": 30, "y": 0, "z": 300, "phi1": 5, "phi2": 0, "feed": 500}, [40, 0, 300]]);
    let report = plan(&service, &json!({"program": {"points": points}, "tool_length": 50})).await;
    assert_eq!(report["verdict"], "ok", "{report}");
    assert!(report["warnings"].to_string().contains("its axis is (0, 0, 1)"), "{report}");
    let rows = rows_of(&service, &report).await;
    let axis = rows.iter().rev().find(|row| row.line == 4).unwrap().position.axis;
    let [sine, cosine] = [5_f64.to_radians().sin(), 5_f64.to_radians().cos()];
    for (axis, expected) in axis.into_iter().zip([0.0, -sine, cosine]) {
        assert!((axis - expected).abs() < 1e-9, "{axis} {expected}");
    }
}

#[tokio::test]
async fn a_job_of_a_tool_path_states_its_kind_and_can_be_cancelled() {
    let service = service().await;
    let points: Vec<Value> = (0..20_000).map(|i| json!([i % 100, i % 97, 300 + i % 31])).collect();
    let body = json!({"program": {"points": points}, "tool_length": 50}).to_string();
    let request = || {
        let request = Request::post("/toolpath").header(CONTENT_TYPE, JSON).header("prefer", "respond-async");
        request.body(body.clone().into()).unwrap()
    };
    let (status, headers, job) = send(&service, request()).await;
    assert_eq!((status, &job["kind"]), (StatusCode::ACCEPTED, &json!("toolpath")), "{job}");
    let path = headers[LOCATION].to_str().unwrap();
    let (status, _, cancelled) = send(&service, Request::delete(path).body(Body::empty()).unwrap()).await;
    assert_eq!(status, StatusCode::OK, "{cancelled}");
    let id = job["id"].as_str().unwrap();
    // The events end with the job.
    let events = Request::get(format!("{path}/events")).body(Body::empty()).unwrap();
    let (_, _, events) = test_service::send(&service, events).await;
    assert!(String::from_utf8_lossy(&events).contains("\"state\":\"cancelled\""), "{events:?}");
    for path in ["", "/rows", "/program", "/path"] {
        let (status, problem) = get(&service, &format!("/toolpath/{id}{path}")).await;
        let expected = (StatusCode::NOT_FOUND, &json!("toolpath_not_found"));
        assert_eq!((status, &problem["code"]), expected, "{path} {problem}");
    }
}

#[tokio::test]
async fn a_program_that_is_not_stored_is_asked_for() {
    let service = service().await;
    let request = json!({"program": "0".repeat(64), "tool_length": 50});
    let (status, problem) = post(&service, "/toolpath", JSON, request.to_string()).await;
    assert_eq!((status, &problem["code"]), (StatusCode::NOT_FOUND, &json!("program_not_found")), "{problem}");
}
