//! What users of `/toolpath/placement` rely on.

use axum::body::Body;
use axum::http::header::{CONTENT_TYPE, LOCATION};
use axum::http::{Request, StatusCode};
use serde_json::{Value, json};

use crate::process::service::Service;
use crate::test_service;

async fn send(service: &Service, request: Request<Body>) -> (StatusCode, Value) {
    let (status, _, bytes) = test_service::send(service, request).await;
    (status, serde_json::from_slice(&bytes).unwrap_or_default())
}

async fn post(service: &Service, path: &str, body: &Value) -> (StatusCode, Value) {
    let request = Request::post(path).header(CONTENT_TYPE, "application/json");
    send(service, request.body(body.to_string().into()).unwrap()).await
}

/// A tilted contour about its own origin.
fn contour() -> Value {
    json!({"points": [[-60, -40, 0, -0.2, -0.2, 1], [60, -40, 10, 0.2, -0.2, 1], [60, 50, 0, 0.2, 0.15, 1],
        [-60, 50, -10, -0.2, 0.15, 1]]})
}

fn asked() -> Value {
    json!({"program": contour(), "tool_length": 100, "setup": {"x": 20, "z": 280},
        "free": {"setup.x": [-200, 200], "setup.z": [0, 600]}, "reserve": {"stroke": 20, "slider_joint": 2}})
}

#[tokio::test]
async fn the_answer_is_what_a_tool_path_in_its_set_up_says() {
    let service = test_service::service("").await;
    let (status, best) = post(&service, "/toolpath/placement", &asked()).await;
    assert_eq!((status, &best["verdict"]), (StatusCode::OK, &json!("ok")), "{best}");
    let t = best["t"].as_f64().unwrap();
    assert!(t > best["given"]["t"].as_f64().unwrap(), "{best}");
    let again = json!({"program": contour(), "tool_length": best["tool_length"], "setup": best["setup"]});
    let (_, report) = post(&service, "/toolpath", &again).await;
    assert_eq!((&report["verdict"], &report["margins"]), (&best["verdict"], &best["margins"]));
    let reserve = |margin: &Value| asked()["reserve"][margin["constraint"].as_str()?].as_f64();
    let ratios = report["margins"].as_array().unwrap().iter();
    let least = ratios.filter_map(|margin| Some(margin["margin"].as_f64()? / reserve(margin)?));
    let least = least.fold(f64::INFINITY, f64::min);
    assert!((least - t).abs() < 1e-9 * t, "{least} {t}");
    let first = &best["active"][0];
    assert!(first["line"].as_u64().unwrap() <= 4 && first["reserve"].is_number(), "{first}");
    assert!(best["guarantee"]["starts"].as_u64().unwrap() > 8, "{best}");
    let path = best["links"]["self"].as_str().unwrap();
    let stored = send(&service, Request::get(path).body(Body::empty()).unwrap()).await;
    assert_eq!(stored, (StatusCode::OK, best.clone()));
    // Defaults and the order of fields make no other question.
    let mut same = asked();
    same["free"] = json!({"setup.z": [-0.0, 600.0], "setup.x": [-200, 200]});
    same["setup"]["c"] = json!(0);
    assert_eq!(post(&service, "/toolpath/placement", &same).await.1["id"], best["id"]);
}

#[tokio::test]
async fn a_tool_is_free_only_if_it_has_one_length() {
    let service = test_service::service("").await;
    let mut request = asked();
    request["free"] = json!({"tool_length": [50, 200]});
    let (status, best) = post(&service, "/toolpath/placement", &request).await;
    assert_eq!(status, StatusCode::OK, "{best}");
    assert!((50.0..=200.0).contains(&best["tool_length"].as_f64().unwrap()), "{best}");
    assert_eq!(best["setup"]["z"], json!(280.0));
    request["tool_length"] = json!({"1": 100});
    request["length_before"] = json!(1);
    let (status, problem) = post(&service, "/toolpath/placement", &request).await;
    assert_eq!(status, StatusCode::UNPROCESSABLE_ENTITY);
    assert_eq!(problem["errors"][0]["pointer"], "/free/tool_length", "{problem}");
}

#[tokio::test]
async fn fields_that_cannot_be_used_are_named() {
    let service = test_service::service("").await;
    for (name, value, pointer) in [
        ("free", json!({}), "/free"),
        ("free", json!({"setup.x": [5, -5]}), "/free/setup.x"),
        ("free", json!({"setup.x": [5]}), "/free/setup.x"),
        ("free", json!({"setup.a": [0, 5]}), "/free/setup.a"),
        ("free", json!({"setup.z": [0, 1e12]}), "/free/setup.z"),
        ("free", json!({"setup.c": [0, 1e6]}), "/free/setup.c"),
        ("free", json!([1]), "/free"),
        ("free", json!(null), "/free"),
        ("reserve", json!({}), "/reserve"),
        ("reserve", json!({"stroke": 0}), "/reserve/stroke"),
        ("reserve", json!({"strokes": 1}), "/reserve/strokes"),
        ("reserve", json!({"table_clearance": 1}), "/reserve/table_clearance"),
        ("setup", json!({"x": "a"}), "/setup/x"),
        ("program", json!({"points": [[1, 2]]}), "/program/points/0"),
        ("fre", json!({}), "/fre"),
        ("offsets", json!({"G54": {"x": 1}}), "/offsets/G54"),
    ] {
        let mut request = asked();
        request[name] = value;
        let (status, problem) = post(&service, "/toolpath/placement", &request).await;
        assert_eq!(status, StatusCode::UNPROCESSABLE_ENTITY, "{request} {problem}");
        assert_eq!(problem["errors"][0]["pointer"], pointer, "{problem}");
    }
    let mut request = asked();
    request.as_object_mut().unwrap().remove("free");
    request.as_object_mut().unwrap().remove("reserve");
    let (_, problem) = post(&service, "/toolpath/placement", &request).await;
    let named: Vec<_> =
        problem["errors"].as_array().unwrap().iter().map(|error| error["pointer"].clone()).collect();
    assert_eq!(named, ["/free", "/reserve"], "{problem}");
}

#[tokio::test]
async fn a_job_of_a_placement_states_its_kind_and_can_be_cancelled() {
    let service = test_service::service("").await;
    let points: Vec<Value> = (0..20_000).map(|i| json!([i % 100, i % 97, i % 31])).collect();
    let mut body = asked();
    body["program"] = json!({"points": points});
    let request = Request::post("/toolpath/placement")
        .header(CONTENT_TYPE, "application/json")
        .header("prefer", "respond-async");
    let (status, headers, job) =
        test_service::send(&service, request.body(body.to_string().into()).unwrap()).await;
    let job: Value = serde_json::from_slice(&job).unwrap();
    assert_eq!((status, &job["kind"]), (StatusCode::ACCEPTED, &json!("placement")), "{job}");
    let path = headers[LOCATION].to_str().unwrap();
    let (status, _) = send(&service, Request::delete(path).body(Body::empty()).unwrap()).await;
    assert_eq!(status, StatusCode::OK);
    let events = Request::get(format!("{path}/events")).body(Body::empty()).unwrap();
    let (_, _, events) = test_service::send(&service, events).await;
    assert!(String::from_utf8_lossy(&events).contains("\"state\":\"cancelled\""), "{events:?}");
}
