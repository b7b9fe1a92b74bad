//! The answer of one batch is the body of another, and the query has what is not a row.

use axum::body::Body;
use axum::http::{Request, StatusCode};
use form_urlencoded::Serializer;
use serde_json::{Map, Value, json};
use verne_rows::Format;

use super::{columns, number, objects, poses, post, post_json, written};
use crate::test_service::{send, service};

const NAMES: [&str; 5] = ["x", "y", "z", "phi1", "phi2"];

fn column<'a>(rows: &'a [Map<String, Value>], name: &'a str) -> impl Iterator<Item = Option<f64>> + 'a {
    rows.iter().map(move |row| number(&row[name]))
}

#[tokio::test]
async fn the_answer_of_the_inverse_problem_is_a_body_of_the_forward_problem() {
    let service = service("").await;
    let poses = poses(40);
    for format in Format::ALL {
        let body = written(format, &columns(&NAMES, &poses));
        let path = "/ik/batch?tool_length=50";
        let (status, _, joints) = post(&service, path, format.media(), body).await;
        assert_eq!(status, StatusCode::OK);
        let inverse = objects(format, &joints);
        let path = "/fk/batch?tool_length=50";
        let (status, _, answer) = post(&service, path, format.media(), joints).await;
        assert_eq!(status, StatusCode::OK, "{}", String::from_utf8_lossy(&answer));
        let rows = objects(format, &answer);
        assert_eq!(rows.len(), poses.len());
        let names: Vec<_> = rows[0].keys().map(String::as_str).collect();
        let status = names.iter().filter(|name| **name == "status").count();
        assert_eq!((names[0], status), ("id", 1), "{format:?}: one column of each name, {names:?}");
        for (i, (there, back)) in inverse.iter().zip(&rows).enumerate() {
            assert_eq!(back["id"], json!(format!("row {i}")));
            if there["rho1"].is_null() || there["rho1"] == "" {
                assert_eq!(back["status"], "invalid", "the status is that of the second answer");
                continue;
            }
            for (k, name) in NAMES[..3].iter().enumerate() {
                let difference = (number(&back[*name]).unwrap() - poses[i][k]).abs();
                assert!(difference < 1e-8, "{format:?}, row {i}, {name}: {difference}");
            }
        }
    }
}

#[tokio::test]
async fn the_query_has_a_machine_as_json() {
    let service = service("").await;
    let request = Request::get("/machines/verne").body(Body::empty()).unwrap();
    let (_, _, document) = send(&service, request).await;
    let mut machine = serde_json::from_slice::<Value>(&document).unwrap()["definition"].take();
    machine["name"] = json!("longer legs");
    for leg in ["L1", "L2", "L3"] {
        machine["geometry"][leg] = json!(machine["geometry"][leg].as_f64().unwrap() + 50.0);
    }
    let poses = poses(20);
    let body = json!({"tool_length": 50, "poses": poses, "machine": machine});
    let expected = post_json(&service, "/ik/batch", body).await;
    let query = |machine: &Value| {
        let mut query = Serializer::new(String::new());
        query.append_pair("tool_length", "50").append_pair("machine", &machine.to_string());
        format!("/ik/batch?{}", query.finish())
    };
    let body = written(Format::Arrow, &columns(&NAMES, &poses));
    let path = query(&machine);
    let (status, headers, answer) = post(&service, &path, Format::Arrow.media(), body.clone()).await;
    assert_eq!(status, StatusCode::OK, "{}", String::from_utf8_lossy(&answer));
    assert_eq!(headers["machine-hash"].to_str().ok(), expected["machine"]["hash"].as_str());
    let found: Vec<_> = column(&objects(Format::Arrow, &answer), "rho1").collect();
    let wanted: Vec<_> = (0..poses.len()).map(|i| expected["joints"][i][0].as_f64()).collect();
    assert_eq!(found, wanted);

    machine["geometry"]["L1"] = json!("long");
    for (path, pointer) in [
        (query(&machine), "/query/machine/geometry/L1"),
        (query(&json!({"geometry": {}})), "/query/machine/geometry/D1"),
        ("/ik/batch?machine=%7B".to_owned(), "/query/machine"),
    ] {
        let (status, _, problem) = post(&service, &path, Format::Arrow.media(), body.clone()).await;
        let problem: Value = serde_json::from_slice(&problem).unwrap();
        assert_eq!(status, StatusCode::UNPROCESSABLE_ENTITY, "{problem}");
        let pointers: Vec<_> =
            problem["errors"].as_array().unwrap().iter().map(|error| &error["pointer"]).collect();
        assert!(pointers.contains(&&json!(pointer)), "{pointer}: {problem}");
    }
}
