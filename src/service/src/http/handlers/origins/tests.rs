//! What users of `/toolpath/origins` rely on.

use axum::body::{Body, Bytes};
use axum::http::header::{CONTENT_TYPE, ETAG};
use axum::http::{HeaderMap, Request, StatusCode};
use serde_json::{Value, json};

use crate::process::service::Service;
use crate::test_service;

async fn post(service: &Service, path: &str, body: &Value) -> (StatusCode, Value) {
    let ask = || async {
        let request = Request::post(path).header(CONTENT_TYPE, "application/json");
        let (status, _, bytes) =
            test_service::send(service, request.body(body.to_string().into()).unwrap()).await;
        (status, serde_json::from_slice::<Value>(&bytes).unwrap_or_default())
    };
    let (status, answer) = ask().await;
    if status != StatusCode::ACCEPTED {
        return (status, answer);
    }
    // The events end with the job.
    get(service, answer["links"]["events"].as_str().unwrap()).await;
    ask().await
}

async fn get(service: &Service, path: &str) -> (StatusCode, HeaderMap, Bytes) {
    test_service::send(service, Request::get(path).body(Body::empty()).unwrap()).await
}

fn asked() -> Value {
    json!({"program": {"points": [[-60, -40, 0], [60, -40, 10], [60, 50, 0, 0.2, 0.15, 1]]}, "tool_length": 100,
        "cell": 80})
}

#[tokio::test]
async fn a_region_has_a_volume_a_mesh_and_slices() {
    let service = test_service::service("").await;
    let (status, region) = post(&service, "/toolpath/origins", &asked()).await;
    assert_eq!(status, StatusCode::OK, "{region}");
    assert!(
        region["volume"].as_f64().unwrap() > 1e6 && region["triangles"].as_u64().unwrap() > 100,
        "{region}"
    );
    assert_eq!(region["places"], region["limiting_places"], "a short program");
    let links = &region["links"];
    let link = |name: &str| links[name].as_str().unwrap().to_owned();
    let (_, _, stored) = get(&service, &link("self")).await;
    assert_eq!(serde_json::from_slice::<Value>(&stored).unwrap(), region);
    let (status, headers, glb) = get(&service, &format!("{}.glb", link("mesh"))).await;
    assert!(status.is_success() && headers.contains_key(ETAG) && glb.starts_with(b"glTF"));
    // The machine can run the program at this origin; it cannot at one beyond the region.
    let mut path = asked();
    path.as_object_mut().unwrap().remove("cell");
    for (z, verdict) in [(300.0, "ok"), (region["bounds"]["max"][2].as_f64().unwrap() + 1.0, "fails")] {
        path["setup"] = json!({"z": z});
        assert_eq!(post(&service, "/toolpath", &path).await.1["verdict"], verdict, "{path}");
    }
    let (_, _, slice) = get(&service, &format!("{}.json?z=300", link("slice"))).await;
    let slice: Value = serde_json::from_slice(&slice).unwrap();
    assert!(slice["area"].as_f64().unwrap() > 1e4 && slice["frame"] == "part", "{slice}");
    let (_, headers, svg) = get(&service, &format!("{}?z=1&format=svg", link("slice"))).await;
    assert!(headers[CONTENT_TYPE] == "image/svg+xml" && svg.starts_with(b"<"));
    // The origin of the request has no effect; its rotation has.
    let mut moved = asked();
    moved["setup"] = json!({"x": 3});
    assert_eq!(post(&service, "/toolpath/origins", &moved).await.1["id"], region["id"]);
    moved["setup"] = json!({"c": 3});
    assert_ne!(post(&service, "/toolpath/origins", &moved).await.1["id"], region["id"]);
}

#[tokio::test]
async fn other_results_have_no_region_and_fields_are_named() {
    let service = test_service::service("").await;
    let mut path = asked();
    path.as_object_mut().unwrap().remove("cell");
    path["setup"] = json!({"z": 300});
    let (_, report) = post(&service, "/toolpath", &path).await;
    let mut window = path.clone();
    for (name, value) in [("parameter", json!("setup.x")), ("from", json!(-1)), ("to", json!(1))] {
        window[name] = value;
    }
    let (_, window) = post(&service, "/toolpath/window", &window).await;
    let [id, window] = [&report, &window].map(|answer| answer["id"].as_str().unwrap());
    for (path, status, code) in [
        (format!("/toolpath/{id}/mesh.glb"), StatusCode::NOT_FOUND, "no_region"),
        (format!("/toolpath/{id}/slice.svg?z=1"), StatusCode::NOT_FOUND, "no_region"),
        (format!("/toolpath/{window}/mesh.glb"), StatusCode::NOT_FOUND, "no_region"),
        (format!("/toolpath/{window}/slice.svg?z=1"), StatusCode::NOT_FOUND, "no_region"),
        (format!("/toolpath/{}/mesh.glb", "0".repeat(64)), StatusCode::NOT_FOUND, "toolpath_not_found"),
    ] {
        let (found, _, problem) = get(&service, &path).await;
        let problem: Value = serde_json::from_slice(&problem).unwrap();
        assert_eq!((found, &problem["code"]), (status, &json!(code)), "{path}");
    }
    for (name, value, pointer) in [
        ("cell", json!(0), "/cell"),
        ("on_limit", json!("retract"), "/on_limit"),
        ("offsets", json!({"G54": {"x": 1}}), "/offsets/G54"),
        ("cels", json!(1), "/cels"),
    ] {
        let mut request = asked();
        request[name] = value;
        let (status, problem) = post(&service, "/toolpath/origins", &request).await;
        assert_eq!(status, StatusCode::UNPROCESSABLE_ENTITY, "{problem}");
        assert_eq!(problem["errors"][0]["pointer"], pointer, "{problem}");
    }
}

#[tokio::test]
async fn a_region_that_is_empty_says_so() {
    let service = test_service::service("").await;
    let request = json!({"program": {"points": [[0, 0, 0], [3000, 0, 0]]}, "tool_length": 100, "cell": 80});
    let (status, region) = post(&service, "/toolpath/origins", &request).await;
    assert_eq!((status, &region["volume"]), (StatusCode::OK, &json!(0.0)), "{region}");
    assert_eq!(region["bounds"], Value::Null);
}
