//! Invalid input of every kind: the answer is a problem document that names the field.

use axum::body::Body;
use axum::http::{Method, Request, header};
use serde_json::{Value, json};

use super::{get, json_request, post, send};

fn reference_machine() -> Value {
    serde_json::from_str(include_str!("../../reference/machine-verne.json")).unwrap()
}

#[tokio::test]
async fn a_problem_names_the_query_parameter() {
    for (query, pointer) in [
        ("", "/query/rho"),
        ("rho=1,2", "/query/rho"),
        ("rho=1,2,3,4", "/query/rho"),
        ("rho=1,2,x", "/query/rho"),
        ("rho=1,NaN,3", "/query/rho/1"),
        ("rho=1,2,inf", "/query/rho/2"),
        ("rho=1e8,2,3", "/query/rho/0"),
        ("rho=1,2,3&rho=1,2,3", "/query/rho"),
        ("rho=1,2,3&theta1=5", "/query/theta2"),
        ("rho=1,2,3&theta1=5&theta2=1e6", "/query/theta2"),
        ("rho=1,2,3&theta1=&theta2=1", "/query/theta1"),
        ("rho=1,2,3&tool_length=-1", "/query/tool_length"),
        ("rho=1,2,3&tool_length=NaN", "/query/tool_length"),
        ("rho=1,2,3&solutions=best", "/query/solutions"),
        ("rho=1,2,3&machine=nautilus", "/query/machine"),
        ("rho=1,2,3&speed=9", "/query/speed"),
        ("rho=1,2,3&near_joints=1,2", "/query/near_joints"),
        ("rho=1,2,3&near_joints=1,2,inf", "/query/near_joints"),
        ("rho=1,2,3&near_pose=1,2,3,nan", "/query/near_pose"),
        ("rho=1,2,3&near_pose=1,2,3&near_joints=1,2,3", "/query/near_pose"),
    ] {
        let reply = get(&format!("/fk?{query}")).await;
        assert_eq!(reply.json["errors"][0]["pointer"], pointer, "{query}: {}", reply.json);
        reply.assert_bad_field(pointer);
    }
}

#[tokio::test]
async fn a_problem_points_to_the_body_field() {
    for (body, pointer) in [
        (r"{}", "/joints"),
        (r#"{"joints": {}}"#, "/joints/rho"),
        (r#"{"joints": [[1, 2, 3], null, null]}"#, "/joints"),
        (r#"{"joints": {"rho": [1, 2]}}"#, "/joints/rho"),
        (r#"{"joints": {"rho": [1, 2, 3, 4]}}"#, "/joints/rho"),
        (r#"{"joints": {"rho": [1, "2", 3]}}"#, "/joints/rho/1"),
        (r#"{"joints": {"rho": [1, null, 3]}}"#, "/joints/rho/1"),
        (r#"{"joints": {"rho": [1, 1e999, 3]}}"#, "/joints/rho/1"),
        (r#"{"joints": {"rho": [1, NaN, 3]}}"#, "/joints/rho/1"),
        (r#"{"joints": {"rho": [1, 2, -Infinity]}}"#, "/joints/rho/2"),
        (r#"{"joints": {"rho": [1, 2, 2e7]}}"#, "/joints/rho/2"),
        (r#"{"joints": {"rho": [1, 2, 3], "theta1": 4}}"#, "/joints/theta2"),
        (r#"{"joints": {"rho": [1, 2, 3], "a/b~c": 4}}"#, "/joints/a~1b~0c"),
        (r#"{"joints": {"rho": [1, 2, 3]}, "joints": {"rho": [1, 2, 3]}}"#, "/joints"),
        (r#"{"joints": {"rho": [1, 2, 3]}, "speed": 4}"#, "/speed"),
        (r#"{"joints": {"rho": [1, 2, 3]}, "tool_length": "50"}"#, "/tool_length"),
        (r#"{"joints": {"rho": [1, 2, 3]}, "solutions": "best"}"#, "/solutions"),
        (r#"{"joints": {"rho": [1, 2, 3]}, "machine": 7}"#, "/machine"),
        (r#"{"joints": {"rho": [1, 2, 3]}, "near": {"rho": [1, 2, 3], "x": 1}}"#, "/near"),
        (r#"{"joints": {"rho": [1, 2, 3]}, "near": {"x": 1, "y": 1e9, "z": 1}}"#, "/near/y"),
    ] {
        let reply = post("/fk", body).await;
        assert_eq!(reply.json["errors"][0]["pointer"], pointer, "{body}: {}", reply.json);
        reply.assert_bad_field(pointer);
    }
}

#[tokio::test]
async fn a_problem_lists_every_invalid_field() {
    let body = json!({"frame": "tool", "pose": {"x": 1e9, "y": -1e9, "z": 0, "phi1": 1}, "tool_length": -1});
    let reply = post("/ik", body).await;
    reply.assert_problem(422, "invalid_request");
    let pointers: Vec<_> =
        reply.json["errors"].as_array().unwrap().iter().map(|e| e["pointer"].clone()).collect();
    assert_eq!(json!(pointers), json!(["/pose/x", "/pose/y", "/tool_length", "/pose/phi1"]));
}

#[tokio::test]
async fn a_problem_points_to_the_invalid_numbers_of_a_machine() {
    let good = reference_machine();
    for (pointer, value) in [
        ("/limits/stroke/0", json!([750, 0])),
        ("/limits/tilt", json!([90, -90])),
        ("/limits/slider_cone", json!(0)),
        ("/limits/serial_margin", json!(1)),
        ("/geometry/L1", json!(-1050)),
        ("/geometry/R1", json!(74)),
        ("/geometry/rod_radius", json!(-1)),
        ("/table/da", json!(1e9)),
        ("/name", json!("")),
    ] {
        let mut machine = good.clone();
        *machine.pointer_mut(pointer).unwrap() = value;
        let body = json!({"machine": machine, "joints": {"rho": [674, 685, 250]}});
        post("/fk", body).await.assert_bad_field(&format!("/machine{pointer}"));
    }
    let mut machine = good;
    machine["limits"]["stroke"] = json!([[0, 1], [0, 1]]);
    let body = json!({"machine": machine, "joints": {"rho": [674, 685, 250]}});
    post("/fk", body).await.assert_bad_field("/machine/limits/stroke");
}

#[tokio::test]
async fn a_body_that_is_not_json_is_400() {
    for body in ["", "{", "{\"joints\": }", "rho=1,2,3", "{\"joints\": {\"rho\": [1, 2, 3]}} x"] {
        post("/fk", body).await.assert_problem(400, "bad_json");
    }
    let deep = "[".repeat(10_000);
    post("/fk", format!("{{\"joints\": {{\"rho\": {deep}")).await.assert_problem(422, "invalid_request");
    post("/fk", "[1]").await.assert_problem(422, "invalid_request");
}

#[tokio::test]
async fn a_body_without_a_json_content_type_is_415() {
    let body = r#"{"joints": {"rho": [674, 685, 250]}}"#;
    for path in ["/fk", "/ik", "/fk/batch", "/ik/batch"] {
        let undeclared = Request::post(path).body(Body::from(body)).unwrap();
        send(undeclared).await.assert_problem(415, "unsupported_media_type");
        let form = Request::post(path)
            .header(header::CONTENT_TYPE, "application/x-www-form-urlencoded")
            .body(Body::from(body))
            .unwrap();
        send(form).await.assert_problem(415, "unsupported_media_type");
    }
    let charset = Request::post("/fk")
        .header(header::CONTENT_TYPE, "Application/JSON; charset=utf-8")
        .body(Body::from(body))
        .unwrap();
    assert_eq!(send(charset).await.solutions().len(), 1);
}

#[tokio::test]
async fn unknown_paths_are_404_and_unknown_methods_405() {
    get("/nowhere").await.assert_problem(404, "not_found");
    get("/fk/").await.assert_problem(404, "not_found");
    get("/machines/nautilus").await.assert_problem(404, "machine_not_found");
    get("/machines/%FF").await.assert_problem(404, "not_found");
    get("/docs/nothing.js").await.assert_problem(404, "not_found");
    for (method, path, allow) in [
        (Method::DELETE, "/fk", "GET,HEAD,POST"),
        (Method::GET, "/ik/batch", "POST"),
        (Method::POST, "/machines", "GET,HEAD"),
    ] {
        let reply = send(json_request(method, path, "{}")).await;
        reply.assert_problem(405, "method_not_allowed");
        assert_eq!(reply.headers[header::ALLOW], allow);
    }
}

#[tokio::test]
async fn the_body_limit_of_a_single_request_is_small() {
    let reply = post("/fk", " ".repeat(65_537)).await;
    reply.assert_problem(413, "body_too_large");
    assert!(reply.json["detail"].as_str().unwrap().contains("65536"));
}
