//! What users of joint programs and paths rely on.

use axum::body::{Body, Bytes};
use axum::http::header::{CONTENT_TYPE, ETAG, IF_NONE_MATCH};
use axum::http::{HeaderMap, Request, StatusCode};
use serde_json::{Value, json};

use crate::process::service::Service;
use crate::test_service::{send, service};

/// Rapids over the table, with events.
const RAPIDS: &str = "UNITS/MM\nLOADTL/3\nSPINDL/RPM,6000,CLW\nRAPID\nGOTO/-50,0,300\nCOOLNT/ON\nPPRINT a) G0 X0 (b\n\
    RAPID\nGOTO/50,0,300\nFINI\n";

async fn get(service: &Service, path: &str) -> (StatusCode, HeaderMap, Bytes) {
    send(service, Request::get(path).body(Body::empty()).unwrap()).await
}

async fn refusal(service: &Service, path: &str) -> (StatusCode, Value) {
    let (status, _, body) = get(service, path).await;
    (status, serde_json::from_slice(&body).unwrap())
}

/// The report on a CL file.
async fn plan(service: &Service, text: &'static str) -> Value {
    let request = Request::post("/toolpath?format=apt&tool_length=100").header(CONTENT_TYPE, "text/plain");
    let (status, _, body) = send(service, request.body(text.into()).unwrap()).await;
    assert_eq!(status, StatusCode::OK, "{body:?}");
    serde_json::from_slice(&body).unwrap()
}

#[tokio::test]
async fn a_joint_program_has_a_block_for_each_row_and_the_events_in_their_places() {
    let service = service("").await;
    let report = plan(&service, RAPIDS).await;
    let path = report["links"]["program"].as_str().unwrap();
    let (status, headers, body) = get(&service, path).await;
    let text = std::str::from_utf8(&body).unwrap();
    assert_eq!(status, StatusCode::OK, "{text}");
    assert_eq!(headers[CONTENT_TYPE], "text/plain");
    assert!(text.contains(report["machine"]["hash"].as_str().unwrap()), "{text}");
    let lines: Vec<&str> = text.lines().skip_while(|line| !line.starts_with("G21")).collect();
    assert_eq!(lines[1..3], ["T3 M6", "S6000 M3"]);
    assert!(lines[3].starts_with("G0 X"), "{text}");
    assert!(lines.contains(&"M8") && lines.contains(&"(a] G0 X0 [b)"), "{text}");
    let blocks =
        lines.iter().filter(|line| line.starts_with(['X', 'Y', 'Z', 'A', 'C']) || line.starts_with("G0"));
    assert_eq!(blocks.count() as u64, report["rows"].as_u64().unwrap(), "{text}");
    assert_eq!(lines.last(), Some(&"M30"));
    let known = Request::get(path).header(IF_NONE_MATCH, &headers[ETAG]).body(Body::empty()).unwrap();
    assert_eq!(send(&service, known).await.0, StatusCode::NOT_MODIFIED);
}

#[tokio::test]
async fn options_change_the_program_or_are_refused_by_name() {
    let service = service("").await;
    let path = plan(&service, RAPIDS).await["links"]["program"].as_str().unwrap().to_owned();
    let query = "axes=U,V,-W,B,C&axis_offsets=0,0,1600&length_decimals=2&numbers=10&head=%25%0AO7&foot=M2";
    let (status, _, body) = get(&service, &format!("{path}?{query}")).await;
    let text = std::str::from_utf8(&body).unwrap();
    assert_eq!(status, StatusCode::OK, "{text}");
    assert!(text.starts_with("%\nO7\n(") && text.ends_with("\nM2\n"), "{text}");
    assert!(
        text.contains("W = 1600.0 - rho3") && text.contains("N10 G21") && text.contains(" G0 U"),
        "{text}"
    );
    for (query, pointer) in [
        ("axes=X,Y,Z,A", "/query/axes"),
        ("axes=X,X,Z,A,C", "/query/axes"),
        ("axes=X,Y,F,A,C", "/query/axes"),
        ("length_decimals=9", "/query/length_decimals"),
        ("length_decimals=1", "/query/length_decimals"),
        ("angle_decimals=0", "/query/angle_decimals"),
        ("greatest_feed=0", "/query/greatest_feed"),
        ("numbers=0", "/query/numbers"),
        ("head=%C3%9C", "/query/head"),
        ("feed_word=g93", "/query/feed_word"),
        // The machine has no drives, so its rapids have no durations.
        ("rapid_word=g1", "/query/rapid_word"),
    ] {
        let (status, problem) = refusal(&service, &format!("{path}?{query}")).await;
        assert_eq!(status, StatusCode::UNPROCESSABLE_ENTITY, "{query}: {problem}");
        assert_eq!(problem["errors"][0]["pointer"], pointer, "{problem}");
    }
}

#[tokio::test]
async fn a_program_that_the_machine_cannot_run_has_no_joint_program() {
    let service = service("").await;
    let report = plan(&service, "UNITS/MM\nRAPID\nGOTO/0,0,300\nRAPID\nGOTO/9000,0,300\nFINI\n").await;
    assert_eq!((&report["verdict"], &report["links"]["program"]), (&json!("fails"), &Value::Null));
    let path = format!("{}/program", report["links"]["self"].as_str().unwrap());
    let (status, problem) = refusal(&service, &path).await;
    assert_eq!((status, &problem["code"]), (StatusCode::CONFLICT, &json!("no_joint_program")));
}

#[tokio::test]
async fn the_path_is_a_glb_in_the_frame_of_the_part() {
    let service = service("").await;
    let report =
        plan(&service, "UNITS/MM\nRAPID\nGOTO/-150,0,300\nFEDRAT/1000,MMPM\nGOTO/150,0,300\nFINI\n").await;
    let path = report["links"]["path"].as_str().unwrap();
    let (status, headers, body) = get(&service, path).await;
    assert_eq!((status, &headers[CONTENT_TYPE]), (StatusCode::OK, &"model/gltf-binary".parse().unwrap()));
    assert!(body.starts_with(b"glTF"));
    let length = u32::from_le_bytes(body[12..16].try_into().unwrap()) as usize;
    let document: Value = serde_json::from_slice(&body[20..20 + length]).unwrap();
    let extras = &document["scenes"][0]["extras"];
    assert_eq!((&extras["id"], &extras["rows_per_point"]), (&report["id"], &json!(1)));
    let primitive = &document["meshes"][0]["primitives"][0];
    assert_eq!(primitive["mode"], json!(1));
    // The rows that the report counts.
    let positions = usize::try_from(primitive["attributes"]["POSITION"].as_u64().unwrap()).unwrap();
    assert_eq!(document["accessors"][positions]["count"], report["rows"]);
    let (status, problem) = refusal(&service, &format!("{path}?least=0.5&greatest=0.5")).await;
    assert_eq!(status, StatusCode::UNPROCESSABLE_ENTITY);
    assert_eq!(problem["errors"][0]["pointer"], "/query/greatest");
}
