//! `/toolpath`: the request of the manual, its job, its links behind a proxy, and keys.

use axum::Router;
use axum::body::Body;
use axum::http::header::{CONTENT_TYPE, LOCATION};
use axum::http::{Method, Request, StatusCode};
use serde_json::{Value, json};

use super::jobs::{cancel, job, one_core, until};
use super::{Reply, get_from, json_request, opened, send_to, service, settings};

/// A contour with two tools, tilted in its second half.
const PART: &str = "PARTNO/COVER\nUNITS/MM\nLOADTL/1\nSPINDL/RPM,6000,CLW\nRAPID\nGOTO/0,0,360,0,0,1\n\
    FEDRAT/800,MMPM\nGOTO/0,0,300\nGOTO/60,0,300\nGOTO/60,40,300,0,0.28,0.96\nLOADTL/2\nRAPID\n\
    GOTO/0,0,360,0,0,1\nGOTO/0,0,310\nGOTO/-40,20,310\nFINI\n";

async fn send_file(service: &Router, query: &str, file: &str) -> Reply {
    let request = Request::post(format!("/toolpath?{query}"));
    // As curl --data-binary sends it.
    let request = request.header(CONTENT_TYPE, "application/x-www-form-urlencoded");
    send_to(service.clone(), request.body(Body::from(file.to_owned())).unwrap()).await
}

async fn send_json(service: &Router, request: &Value) -> Reply {
    send_to(service.clone(), json_request(Method::POST, "/toolpath", request)).await
}

/// A program that takes long to plan.
fn long() -> Value {
    let points: Vec<Value> = (0..20_000).map(|i| json!([i % 100, i % 97, 300 + i % 31])).collect();
    json!({"program": {"points": points}, "tool_length": 50})
}

#[tokio::test]
async fn the_request_of_the_manual_gets_a_report() {
    let service = service().await;
    let reply = send_file(&service, "format=apt&tool_length=120", PART).await;
    assert_eq!(reply.status, StatusCode::OK, "{}", reply.json);
    assert_eq!((&reply.json["verdict"], &reply.json["failures"]), (&json!("ok"), &json!([])));
    let again = get_from(&service, reply.json["links"]["self"].as_str().unwrap(), &[]).await;
    assert_eq!((again.status, &again.bytes), (StatusCode::OK, &reply.bytes));
    // The program is stored, and its id asks for the same.
    let request = json!({"program": reply.json["program"], "tool_length": 120});
    assert_eq!(send_json(&service, &request).await.json["id"], reply.json["id"]);
    let of_tools = send_file(&service, "format=apt&tool_length={%221%22:120,%222%22:95}", PART).await;
    assert_eq!(of_tools.json["verdict"], "ok", "{}", of_tools.json);
    let missing = send_file(&service, "format=apt&tool_length={%221%22:120}", PART).await;
    missing.assert_problem(422, "program_fault");
    assert_eq!(missing.json["errors"][0]["line"], 11, "{}", missing.json);
    get_from(&service, &format!("/workspace/{}", reply.json["id"].as_str().unwrap()), &[])
        .await
        .assert_problem(404, "workspace_not_found");
}

#[tokio::test]
async fn a_line_out_of_reach_fails_with_its_text() {
    let file = "UNITS/MM\nGOTO/0,0,300\n$$ too far\nGOTO/900,0,300\nGOTO/0,0,300\n";
    let reply = send_file(&service().await, "format=apt&tool_length=50", file).await;
    assert_eq!((reply.status, &reply.json["verdict"]), (StatusCode::OK, &json!("fails")), "{}", reply.json);
    let failure = &reply.json["failures"][0];
    assert_eq!((&failure["lines"][0], &failure["text"]), (&json!(4), &json!("GOTO/900,0,300")));
    assert!(failure["margin"].as_f64().unwrap() < 0.0, "{failure}");
}

#[tokio::test]
async fn a_running_plan_is_cancelled_and_can_be_asked_for_again() {
    let service = opened(&one_core()).await;
    let started = |service: &Router| {
        let mut request = json_request(Method::POST, "/toolpath", long());
        request.headers_mut().insert("prefer", "respond-async".parse().unwrap());
        send_to(service.clone(), request)
    };
    let first = started(&service).await;
    assert_eq!((first.status, &first.json["kind"]), (StatusCode::ACCEPTED, &json!("toolpath")));
    let id = first.json["id"].as_str().unwrap();
    assert_eq!(first.headers[LOCATION], format!("/jobs/{id}"));
    until(&service, id, |job| job["progress"].as_f64() > Some(0.0)).await;
    cancel(&service, id).await;
    until(&service, id, |job| job["state"] == "cancelled").await;
    assert_eq!(job(&service, id).await["result"], Value::Null);
    let second = started(&service).await;
    assert_eq!((second.status, &second.json["id"]), (StatusCode::ACCEPTED, &first.json["id"]));
    cancel(&service, id).await;
}

#[tokio::test]
async fn links_of_reports_contain_the_published_address() {
    let service = opened(&settings("--memory-only --base-path /tools/verne")).await;
    let request = json!({"program": {"points": [[0, 0, 300], [5, 0, 300]]}, "tool_length": 50});
    let reply = send_json(&service, &request).await;
    let id = reply.json["id"].as_str().unwrap();
    assert_eq!(reply.json["links"]["self"], format!("/tools/verne/toolpath/{id}"));
    let job = get_from(&service, &format!("/tools/verne/jobs/{id}"), &[]).await.json;
    assert_eq!((&job["result"], &job["kind"]), (&reply.json["links"]["self"], &json!("toolpath")));
}
