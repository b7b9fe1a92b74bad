//! The Jacobian of solutions and of rows.

use axum::body::Body;
use axum::http::Request;
use serde_json::{Value, json};

use super::{get, post, send};

const POSE: &str = "/ik?x=60&y=-40&z=300&phi1=12&phi2=50&tool_length=80&jacobian=true";

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

/// The answer to rows in CSV.
async fn rows_of(uri: &str, rows: &'static str) -> String {
    let request = Request::post(uri).header("content-type", "text/csv").body(Body::from(rows));
    String::from_utf8(send(request.unwrap()).await.bytes).unwrap()
}

fn with_drives() -> Value {
    let mut machine: Value =
        serde_json::from_str(include_str!("../../reference/machine-verne.json")).unwrap();
    machine["drives"] =
        json!({"slider": {"velocity": 500}, "tilt": {"velocity": 60}, "rotary": {"velocity": 90}});
    machine
}

#[tokio::test]
async fn the_matrix_maps_small_changes_of_the_joints_to_those_of_the_tool() {
    let reply = get(POSE).await;
    let solution = &reply.solutions()[0];
    let jacobian = &solution["jacobian"];
    assert_eq!(jacobian["singularities"], json!([]));
    assert_eq!(jacobian["det_p"], solution["conditioning"]["det"]);
    assert!(jacobian.get("greatest_speeds").is_none(), "the built-in machine has no drives");
    let names =
        |list: &str| jacobian[list].as_array().unwrap().iter().map(|rate| rate["name"].clone()).collect();
    assert_eq!(Value::Array(names("rows")), json!(["x", "y", "z", "phi1", "sin_phi1_phi2"]));
    assert_eq!(Value::Array(names("columns")), json!(["rho1", "rho2", "rho3", "theta1", "theta2"]));
    let joints = &solution["joints"];
    let tool = async |joint: usize, step: f64| {
        let mut moved = joints.clone();
        let field =
            if joint < 3 { &mut moved["rho"][joint] } else { &mut moved[["theta1", "theta2"][joint - 3]] };
        *field = json!(number(field) + step);
        post("/fk", json!({"joints": moved, "tool_length": 80})).await.solutions()[0]["part"].clone()
    };
    let sine = 12_f64.to_radians().sin();
    for joint in 0..5 {
        let (step, unit) = if joint < 3 { (1e-3, 1e-3) } else { (1e-4, 1e-4_f64.to_radians()) };
        let [low, high] = [tool(joint, -step).await, tool(joint, step).await];
        for (row, name) in ["x", "y", "z", "phi1", "phi2"].into_iter().enumerate() {
            let change = 0.5 * (number(&high[name]) - number(&low[name])) / unit;
            let rate = match row {
                3 => change.to_radians(),
                4 => sine * change.to_radians(),
                _ => change,
            };
            let found = number(&jacobian["matrix"][row][joint]);
            assert!((found - rate).abs() < 1e-6 * rate.abs().max(1.0), "{name} {joint}: {found} {rate}");
        }
    }
}

#[tokio::test]
async fn a_pole_has_null_and_a_reason() {
    let reply = get("/ik?x=0&y=0&z=300&tool_length=80&jacobian=true").await;
    let jacobian = &reply.solutions()[0]["jacobian"];
    assert_eq!(jacobian["condition_number"], Value::Null);
    assert_eq!(jacobian["singularities"], json!(["pole"]));
    assert!(jacobian["matrix"].is_array() && jacobian["singular_values"].is_array());
}

#[tokio::test]
async fn drives_bound_the_speeds_of_the_tool() {
    let body = json!({"machine": with_drives(), "pose": {"x": 60, "y": -40, "z": 300, "phi1": 12, "phi2": 50},
                      "tool_length": 80, "jacobian": true, "characteristic_length": 100});
    let reply = post("/ik", body).await;
    let jacobian = &reply.solutions()[0]["jacobian"];
    assert_eq!(jacobian["characteristic_length"], 100.0);
    for axis in ["x", "y", "z"] {
        let speed = &jacobian["greatest_speeds"][axis];
        assert!(number(&speed["speed"]) > 10.0 && speed["joint"].is_string(), "{speed}");
    }
    assert!(number(&jacobian["error_amplification"]["rho1"]) > 0.1);
}

#[tokio::test]
async fn a_batch_has_the_jacobians_of_single_answers() {
    let pose = json!({"x": 60, "y": -40, "z": 300, "phi1": 12, "phi2": 50});
    let single = post("/ik", json!({"machine": with_drives(), "pose": pose, "jacobian": true})).await;
    let single = &single.solutions()[0]["jacobian"];
    let body = json!({"machine": with_drives(), "jacobian": "matrix",
                      "poses": [[60, -40, 300, 12, 50], null, [9000, 0, 300, 0, 0], [0, 0, 300, 0, 0]]});
    let batch = post("/ik/batch", body).await.json["jacobian"].clone();
    assert_eq!(batch["matrix"][0], single["matrix"]);
    assert_eq!(batch["det_p"][0], single["det_p"]);
    assert_eq!(batch["condition_number"][0], single["condition_number"]);
    assert_eq!(batch["greatest_speeds"][0][2], single["greatest_speeds"]["z"]["speed"]);
    for column in ["matrix", "det_p", "condition_number", "greatest_speeds"] {
        assert_eq!(batch[column][1], Value::Null, "{column}");
        assert_eq!(batch[column][2], Value::Null, "{column}");
    }
    assert_eq!(batch["condition_number"][3], Value::Null, "the pole");
    let body = json!({"jacobian": "condition", "joints": [[600, 500, 500, 5, 0], [600, 500, 500]]});
    let reply = post("/fk/batch", body).await.json;
    assert!(number(&reply["jacobian"]["condition_number"][0]) > 1.0);
    assert!(reply["jacobian"].get("matrix").is_none());
    assert_eq!(reply["status"], json!(["ok", "invalid"]), "the Jacobian needs the table's angles");
}

#[tokio::test]
async fn a_table_has_the_columns_that_the_request_names() {
    let rows = "x,y,z,phi1,phi2\n60,-40,300,12,50\n";
    let answer = rows_of("/ik/batch?format=csv&tool_length=80&jacobian=matrix", rows).await;
    let mut lines = answer.lines();
    let names: Vec<_> = lines.next().unwrap().split(',').collect();
    let values: Vec<_> = lines.next().unwrap().split(',').collect();
    let reply = get(POSE).await;
    let jacobian = &reply.solutions()[0]["jacobian"];
    let value =
        |name: &str| values[names.iter().position(|found| *found == name).unwrap()].parse::<f64>().unwrap();
    assert_eq!(value("condition_number"), number(&jacobian["condition_number"]));
    assert_eq!(value("det_p"), number(&jacobian["det_p"]));
    assert_eq!(value("j11"), number(&jacobian["matrix"][0][0]));
    assert_eq!(value("j25"), number(&jacobian["matrix"][1][4]));
    let rows = "rho1,rho2,rho3,theta1,theta2\n600,500,500,5,0\n";
    let answer = rows_of("/fk/batch?format=csv&jacobian=condition", rows).await;
    assert!(answer.contains("det_p,condition_number,status"), "{answer}");
}

#[tokio::test]
async fn a_jacobian_needs_the_angles_of_the_table() {
    let refused = [
        ("/fk?rho=600,500,500&jacobian=true", "/query/jacobian"),
        ("/ik?frame=platform&x=0&y=0&z=1200&jacobian=true", "/query/jacobian"),
        ("/ik?frame=tool&x=0&y=0&z=1200&jacobian=true", "/query/jacobian"),
        ("/ik?x=0&y=0&z=300&characteristic_length=5", "/query/characteristic_length"),
        ("/ik?x=0&y=0&z=300&jacobian=true&characteristic_length=0", "/query/characteristic_length"),
    ];
    for (uri, pointer) in refused {
        let reply = get(uri).await;
        assert_eq!(reply.status, 422, "{uri}");
        assert_eq!(reply.json["errors"][0]["pointer"], pointer, "{uri}");
    }
    let body = json!({"frame": "tool", "poses": [[0, 0, 1200]], "jacobian": "condition"});
    assert_eq!(post("/ik/batch", body).await.json["errors"][0]["pointer"], "/jacobian");
}
