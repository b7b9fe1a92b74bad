//! Machines: listed, described, in a request, read from a directory.

use std::path::{Path, PathBuf};

use axum::body::Body;
use axum::http::Request;
use serde_json::{Value, json};

use verne_service::Service;

use super::{config, get, opened, post, send_to};

const REFERENCE: &str = include_str!("../../reference/machine-verne.json");

#[tokio::test]
async fn the_built_in_machines_are_marked_as_invented() {
    let reply = get("/machines/verne").await;
    let reference: Value = serde_json::from_str(REFERENCE).unwrap();
    assert_eq!(as_floats(&reply.json["definition"]), as_floats(&reference));
    let list = get("/machines").await;
    let [delta, verne] = [0, 1].map(|i| &list.json["machines"][i]);
    assert_eq!(verne["hash"], reply.json["machine"]["hash"]);
    assert!(verne["description"].as_str().unwrap().contains("Not Fatronik's"));
    assert_eq!(delta["name"], "linear-delta");
    assert!(delta["description"].as_str().unwrap().contains("invented"));
}

#[tokio::test]
async fn a_linear_delta_has_no_margin_of_crossed_rods_and_does_not_turn() {
    let definition = get("/machines/linear-delta").await.json["definition"].clone();
    assert_eq!(definition["geometry"]["parallelogram_direction"], -30.0);
    let all = get("/ik?frame=platform&x=120&y=-80&z=800&machine=linear-delta&solutions=all").await;
    assert_eq!(all.solutions().len(), 16);
    let working = &all.solutions()[0];
    assert!(working["working"] == true && working["feasible"] == true);
    assert_eq!(working["platform"]["alpha"].to_string(), "0.0");
    assert!(working["margins"].get("rod_crossing").is_none());
    for crossed in all.solutions().iter().filter(|solution| solution["mode"]["crossed"] == true) {
        assert!(crossed["margins"]["rod_crossing"].as_f64().unwrap() < 0.0 && crossed["feasible"] == false);
    }
    let body = json!({"machine": definition, "joints": {"rho": working["joints"]["rho"]}});
    let back = post("/fk", body).await;
    assert_eq!(back.json["machine"]["hash"], all.json["machine"]["hash"]);
    assert!((back.solutions()[0]["platform"]["x"].as_f64().unwrap() - 120.0).abs() < 1e-9);
}

#[tokio::test]
async fn a_parallelogram_in_another_direction_needs_a_platform_that_does_not_turn() {
    let mut machine: Value = serde_json::from_str(REFERENCE).unwrap();
    machine["geometry"]["parallelogram_direction"] = json!(-30);
    let body = json!({"machine": machine, "joints": {"rho": [674, 685, 250]}});
    post("/fk", body).await.assert_bad_field("/machine/geometry/parallelogram_direction");
}

#[tokio::test]
async fn a_machine_in_the_request_is_used() {
    let named = get("/fk?rho=674,685,250").await;
    let mut machine: Value = serde_json::from_str(REFERENCE).unwrap();
    let body = json!({"machine": machine, "joints": {"rho": [674, 685, 250]}});
    assert_eq!(post("/fk", body).await.json, named.json);

    machine["name"] = json!("other");
    machine["description"] = json!("the same numbers");
    let body = json!({"machine": machine, "joints": {"rho": [674, 685, 250]}});
    let renamed = post("/fk", body).await.json;
    assert_eq!(renamed["machine"]["name"], "other");
    assert_eq!(renamed["machine"]["hash"], named.json["machine"]["hash"], "the hash is of the numbers");

    machine["limits"]["slider_cone"] = json!(20);
    machine["limits"]["slider_axes"] = json!([[0, 0, 1], [0, 0, 1], [0, 0, 1], [0, 0, 1]]);
    let body = json!({"machine": machine, "joints": {"rho": [674, 685, 250]}});
    let tighter = post("/fk", body).await.json;
    assert_ne!(tighter["machine"]["hash"], named.json["machine"]["hash"]);
    assert_eq!(tighter["solutions"][0]["feasible"], false);
}

#[tokio::test]
async fn the_schema_describes_the_machine() {
    let schema = get("/machines/schema").await.json;
    assert_eq!(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
    assert_eq!(schema["required"], json!(["name", "geometry", "table", "limits"]));
    assert_eq!(schema["additionalProperties"], false);
    let stroke = &schema["properties"]["limits"]["properties"]["stroke"];
    assert_eq!((&stroke["type"], &stroke["minItems"]), (&json!("array"), &json!(3)));
    assert!(!schema.to_string().contains("$ref"), "it stands on its own");
}

#[tokio::test]
async fn the_machines_of_a_directory_are_listed() {
    let directory = scratch("published");
    let tight = REFERENCE.replace("\"verne\"", "\"tight\"").replace("[0, 750]", "[100, 400]");
    std::fs::write(directory.join("tight.json"), tight).unwrap();
    std::fs::write(directory.join("notes.txt"), "not a machine").unwrap();
    let service = opened(&config(Some(directory))).await;
    let request = Request::get("/fk?rho=674,685,250&machine=tight").body(Body::empty()).unwrap();
    let reply = send_to(service, request).await;
    assert_eq!(reply.json["machine"]["name"], "tight");
    assert_eq!(reply.solutions()[0]["feasible"], false);
}

#[tokio::test]
async fn an_invalid_machine_file_names_file_and_field() {
    for (name, text, expected) in [
        ("range", REFERENCE.replace("\"verne\"", "\"x\"").replace("[-90, 90]", "[90, -90]"), "/limits/tilt"),
        ("missing", REFERENCE.replace("\"dt\"", "\"dd\""), "/table/dd"),
        ("taken", REFERENCE.to_owned(), "already published"),
        ("schema", REFERENCE.replace("\"verne\"", "\"schema\""), "/name"),
        ("syntax", "{".to_owned(), "not JSON"),
    ] {
        let directory = scratch(name);
        std::fs::write(directory.join("bad.json"), text).unwrap();
        let error = Service::open(&config(Some(directory))).await.err().unwrap().to_string();
        assert!(error.contains("bad.json") && error.contains(expected), "{error}");
    }
    let error = Service::open(&config(Some("/no/such/directory".into()))).await.err().unwrap();
    assert!(error.to_string().contains("/no/such/directory"));
}

fn scratch(name: &str) -> PathBuf {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join("machines").join(name);
    drop(std::fs::remove_dir_all(&directory));
    std::fs::create_dir_all(&directory).unwrap();
    directory
}

/// Integers and floats alike.
fn as_floats(value: &Value) -> Value {
    match value {
        Value::Number(number) => json!(number.as_f64()),
        Value::Array(items) => items.iter().map(as_floats).collect(),
        Value::Object(members) => {
            members.iter().map(|(name, value)| (name.clone(), as_floats(value))).collect()
        }
        other => other.clone(),
    }
}
