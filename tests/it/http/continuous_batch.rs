//! Batches with tool axes, and continuous ones.

use axum::http::StatusCode;
use serde_json::{Value, json};

use super::workspace::covered_twice;
use super::{Reply, get, post};

async fn answered(request: Value) -> Value {
    let reply: Reply = post("/ik/batch", request).await;
    assert_eq!(reply.status, StatusCode::OK, "{}", reply.json);
    reply.json
}

fn start_of(row: &Value) -> Value {
    json!({"rho": [row[0], row[1], row[2]], "theta1": row[3], "theta2": row[4]})
}

fn row_of(joints: &Value) -> Value {
    let rho = &joints["rho"];
    json!([rho[0], rho[1], rho[2], joints["theta1"], joints["theta2"]])
}

/// What a program's rows did before they could be continuous: theta2 jumps by 359° with every row `ok`.
#[tokio::test]
async fn a_program_that_crosses_half_a_turn_is_continuous() {
    let poses: Vec<_> =
        (0..10).map(|i| [60.0, 20.0, 300.0, 20.0, f64::from((175 + i + 180) % 360) - 180.0]).collect();
    let theta2 = |answer: &Value| -> Vec<f64> {
        let joints = answer["joints"].as_array().unwrap();
        joints.iter().map(|row| row[4].as_f64().unwrap()).collect()
    };
    let apart = |theta2: &[f64]| theta2.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max);
    let request = json!({"tool_length": 100, "poses": poses});
    let by_row = answered(request.clone()).await;
    assert_eq!(by_row["counts"]["ok"], 10);
    assert!(apart(&theta2(&by_row)) > 358.0);
    assert!(by_row.get("jump").is_none() && by_row.get("jumps").is_none(), "only if asked");
    let mut request = request;
    request["continuous"] = json!(true);
    for start in [Value::Null, start_of(&by_row["joints"][0])] {
        request["start"] = start;
        let answer = answered(request.clone()).await;
        assert_eq!(answer["counts"]["ok"], 10);
        assert!(apart(&theta2(&answer)) < 1.0 + 1e-9, "{answer}");
        assert_eq!(answer["jump"], json!(vec![false; 10]));
        assert_eq!(answer["jumps"], 0);
    }
}

#[tokio::test]
async fn a_row_continues_in_its_own_working_solution() {
    let machine = covered_twice();
    let pose = json!([-16.3, 0.13, -789.0, 0, 0]);
    let single =
        json!({"machine": machine, "pose": {"x": -16.3, "y": 0.13, "z": -789.0, "phi1": 0, "phi2": 0}});
    let working = post("/ik", single).await.solutions().clone();
    assert_eq!(working.len(), 3);
    for solution in &working {
        // The joints of an answer are a start as they are.
        let (start, row) = (&solution["joints"], row_of(&solution["joints"]));
        let near = [pose.clone(), json!([-16.3, 0.13, -789.001, 0, 0]), pose.clone()];
        let request = json!({"machine": machine, "poses": near, "continuous": true, "start": start});
        let answer = answered(request).await;
        assert_eq!(answer["jump"], json!([false, false, false]), "{answer}");
        for (found, wanted) in answer["joints"][2].as_array().unwrap().iter().zip(row.as_array().unwrap()) {
            assert!((found.as_f64().unwrap() - wanted.as_f64().unwrap()).abs() < 1e-6, "{answer}");
        }
    }
}

#[tokio::test]
async fn a_solution_states_its_windings() {
    for (orientation, windings) in [("phi1=20&phi2=30", 2), ("phi1=20&phi2=0", 3), ("phi1=20&phi2=360", 3)] {
        for wanted in ["all", "working"] {
            let uri = format!("/ik?x=60&y=20&z=300&{orientation}&tool_length=100&solutions={wanted}");
            for solution in get(&uri).await.solutions() {
                assert_eq!(solution["windings"], windings, "{orientation}");
            }
        }
    }
    let mut machine = get("/machines/verne").await.json["definition"].clone();
    machine["limits"]["rotary"] = json!([-20, 20]);
    let pose = json!({"x": 60, "y": 20, "z": 300, "phi1": 20, "phi2": 30});
    let reply = post("/ik", json!({"machine": machine, "pose": pose, "tool_length": 100})).await;
    assert_eq!(reply.solutions()[0]["windings"], 0);
    machine["limits"]["rotary"] = json!(null);
    let pose = json!({"x": 60, "y": 20, "z": 300, "phi1": 20, "phi2": -4000});
    let reply = post("/ik", json!({"machine": machine, "pose": pose, "tool_length": 100})).await;
    let solution = &reply.solutions()[0];
    assert_eq!(solution.get("windings"), Some(&json!(null)), "there is no limit");
    assert_eq!(solution["joints"]["theta2"], 4000.0);
    assert!(solution["margins"].get("rotary").is_none());
    let base = get("/ik?frame=platform&x=0&y=0&z=1200").await;
    assert!(base.solutions()[0].get("windings").is_none());
    let forward = get("/fk?rho=674,685,250&theta1=0&theta2=0").await;
    assert!(forward.solutions()[0].get("windings").is_none());
}

#[tokio::test]
async fn an_axis_in_a_row_is_solved_like_the_axis_of_a_single_request() {
    let axis = [0.3, -0.4, 1.2];
    let batch = answered(json!({"tool_length": 50, "poses": [[100, 50, 150, 0.3, -0.4, 1.2]]})).await;
    let pose = json!({"x": 100, "y": 50, "z": 150, "axis": axis});
    let single = post("/ik", json!({"tool_length": 50, "pose": pose})).await;
    let rows: Vec<_> = single.solutions().iter().map(|solution| row_of(&solution["joints"])).collect();
    assert!(rows.contains(&batch["joints"][0]), "{batch}");
    let refused =
        answered(json!({"frame": "tool", "poses": [[0, 0, 1200, 0, 0, 1], [0, 0, 1200, 0, 0]]})).await;
    assert_eq!(refused["status"], json!(["invalid", "invalid"]));
    assert!(refused["errors"][0]["detail"].as_str().unwrap().contains("only rows of frame part"));
}

#[tokio::test]
async fn a_wrong_start_is_refused() {
    let ask = async |fields: Value| {
        let mut request = json!({"poses": [], "continuous": true});
        for (name, value) in fields.as_object().unwrap() {
            request[name] = value.clone();
        }
        post("/ik/batch", request).await
    };
    ask(json!({"frame": "tool"})).await.assert_bad_field("/continuous");
    let start = |row: [f64; 5]| json!({"start": start_of(&json!(row))});
    let standing = start([400.0, 500.0, 500.0, 0.0, 0.0]);
    ask(json!({"continuous": false, "start": standing["start"]})).await.assert_bad_field("/start");
    ask(json!({"start": [400, 500, 500, 0, 0]})).await.assert_bad_field("/start");
    ask(json!({"start": {"theta1": 0, "theta2": 0}})).await.assert_bad_field("/start/rho");
    ask(json!({"start": {"rho": [400, 500, 500], "theta2": 0}})).await.assert_bad_field("/start/theta1");
    ask(start([400.0, 1e9, 500.0, 0.0, 0.0])).await.assert_bad_field("/start/rho/1");
    ask(start([400.0, 500.0, 500.0, 0.0, 40_000.0])).await.assert_bad_field("/start/theta2");
    ask(start([400.0, 5000.0, 500.0, 0.0, 0.0])).await.assert_bad_field("/start/rho");
    assert_eq!(ask(standing).await.json["jump"], json!([]));
}
