//! Batches: order, isolation of invalid rows, limits.

use axum::http::StatusCode;
use serde_json::{Value, json};

use super::{get, post};

#[tokio::test]
async fn rows_are_answered_in_order_like_single_requests() {
    let poses: Vec<_> =
        (0..500).map(|i| [f64::from(i) - 250.0, 100.0 - f64::from(i % 200), 1100.0]).collect();
    let reply = post("/ik/batch", json!({"frame": "platform", "poses": poses})).await;
    assert_eq!(reply.status, StatusCode::OK);
    let joints = reply.json["joints"].as_array().unwrap();
    assert_eq!(joints.len(), poses.len());
    for i in [0, 123, 499] {
        let [x, y, z] = poses[i];
        let single = get(&format!("/ik?frame=platform&x={x}&y={y}&z={z}")).await;
        assert_eq!(single.solutions()[0]["joints"]["rho"], joints[i]);
    }
    let counts = reply.json["counts"].as_object().unwrap();
    assert_eq!(counts.values().map(|count| count.as_u64().unwrap()).sum::<u64>(), 500);
}

/// Rows as text, for what `Value` cannot hold, with the status that each gets.
const ROWS: [(&str, &str); 16] = [
    ("[100, 50, 150, 0, 0]", "ok"),
    ("null", "invalid"),
    ("[]", "invalid"),
    ("[100, 50, 150, 0]", "invalid"),
    ("[100, 50, 150, 0, 0, 0]", "invalid"),
    ("[100, null, 150, 0, 0]", "invalid"),
    ("[100, \"50\", 150, 0, 0]", "invalid"),
    ("[100, 1e999, 150, 0, 0]", "invalid"),
    ("[100, [50, 150], 0, 0]", "invalid"),
    ("{\"x\": 1}", "invalid"),
    ("\"[100, 50, 150, 0, 0]\"", "invalid"),
    ("[3e6, 50, 150, 0, 0]", "unreachable"),
    ("[100, 50, 150, 0, 0, 1, 0]", "invalid"),
    ("[100, 50, 150, 0, 0, 1e999]", "invalid"),
    ("[ 100 ,\n 50.0, 1.5e2, 0, 0 ]", "ok"),
    ("[100, 50, 150, 0, -0.0, 1e300]", "ok"),
];

#[tokio::test]
async fn an_invalid_row_does_not_affect_the_others() {
    let rows: Vec<_> = ROWS.iter().map(|(row, _)| *row).collect();
    let body = format!("{{\"tool_length\": 50, \"poses\": [{}]}}", rows.join(", "));
    let reply = post("/ik/batch", body).await;
    let expected: Vec<_> = ROWS.iter().map(|(_, status)| *status).collect();
    assert_eq!(reply.json["status"], json!(expected), "{}", reply.json);
    let joints = reply.json["joints"].as_array().unwrap();
    assert_eq!([&joints[0], &joints[0]], [&joints[14], &joints[15]]);
    assert_eq!(joints[0].as_array().unwrap().len(), 5);
    assert!(joints[1..14].iter().all(Value::is_null));
    assert_eq!(reply.json["counts"], json!({"ok": 3, "unreachable": 1, "infeasible": 0, "invalid": 12}));
    let explained: Vec<_> =
        reply.json["errors"].as_array().unwrap().iter().map(|e| e["row"].clone()).collect();
    assert_eq!(json!(explained), json!([1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 13]));
    assert_eq!(reply.json["constraint"][11], "leg_length");
}

#[tokio::test]
async fn every_solved_row_names_its_least_margin() {
    let reply = post("/ik/batch", json!({"frame": "platform", "poses": [[0, 0, 700], [0, 0, 1200]]})).await;
    assert_eq!(reply.json["status"], json!(["infeasible", "ok"]));
    assert!(reply.json["joints"][0].is_array(), "joints that break a limit are answered");
    for (i, z) in [700, 1200].into_iter().enumerate() {
        let single = get(&format!("/ik?frame=platform&x=0&y=0&z={z}")).await;
        let worst = &single.solutions()[0]["margins"]["worst"];
        for (column, field) in [("constraint", "constraint"), ("margin", "value"), ("element", "element")] {
            assert_eq!(reply.json[column][i], worst[field]);
        }
    }
    assert!(reply.json["margin"][1].as_f64().unwrap() > 0.0, "the least margin of a feasible row");
}

#[tokio::test]
async fn forward_rows_with_table_angles_have_a_part_pose() {
    let joints = json!([[674, 685, 250], [674, 685, 250, 10, 20], [674, 685], [0, 0, 9000]]);
    let reply = post("/fk/batch", json!({"joints": joints, "tool_length": 50})).await;
    assert_eq!(reply.json["status"][2], "invalid");
    assert_eq!(reply.json["status"][3], "unreachable");
    assert_eq!(reply.json["poses"][0], reply.json["poses"][1]);
    assert!(reply.json["parts"][0].is_null());
    let single = get("/fk?rho=674,685,250&theta1=10&theta2=20&tool_length=50").await;
    let part = &single.solutions()[0]["part"];
    let row = json!([part["x"], part["y"], part["z"], part["phi1"], part["phi2"]]);
    assert_eq!(reply.json["parts"][1], row);
    let vector = json!({"joints": joints, "tool_length": 50, "orientation": "vector"});
    let reply = post("/fk/batch", vector).await;
    let axis = &part["axis"];
    let row = json!([part["x"], part["y"], part["z"], axis[0], axis[1], axis[2]]);
    assert_eq!(reply.json["parts"], json!([null, row, null, null]));
    post("/fk/batch", json!({"joints": [], "orientation": "axis"})).await.assert_bad_field("/orientation");
}

#[tokio::test]
async fn an_invalid_forward_row_does_not_affect_the_others() {
    let good = "[674, 685, 250]";
    let bad = [
        "null",
        "[674, null, 250]",
        "[674, \"685\", 250]",
        "[674, 685]",
        "[674, 685, 250, 1]",
        "[1e8, 2, 3]",
        "[1, 2, 3, 4e5, 6]",
        "{}",
        "true",
        "7",
        "[[1, 2, 3]]",
        "[674, 685, 1e999]",
    ];
    for bad in bad {
        let reply = post("/fk/batch", format!("{{\"joints\": [{good}, {bad}, {good}]}}")).await;
        assert_eq!(reply.json["status"], json!(["ok", "invalid", "ok"]), "{bad}: {}", reply.json);
        assert_eq!(reply.json["errors"][0]["row"], 1, "{bad}");
    }
}

#[tokio::test]
async fn a_batch_that_is_too_long_is_refused_with_the_limit() {
    let poses = vec![[0.0, 0.0, 1200.0]; 2_001];
    let reply = post("/ik/batch", json!({"frame": "platform", "poses": poses})).await;
    reply.assert_problem(413, "too_many_rows");
    assert!(reply.json["detail"].as_str().unwrap().contains("2000"));
    let reply = post("/fk/batch", " ".repeat(1024 * 1024 + 1)).await;
    reply.assert_problem(413, "body_too_large");
    assert!(reply.json["detail"].as_str().unwrap().contains("1048576"));
}

#[tokio::test]
async fn shared_fields_of_a_batch_are_checked() {
    post("/ik/batch", "{\"poses\": 3}").await.assert_bad_field("/poses");
    post("/ik/batch", "{}").await.assert_bad_field("/poses");
    post("/ik/batch", "{\"poses\": [], \"tool_length\": -1}").await.assert_bad_field("/tool_length");
    post("/fk/batch", "{\"joints\": [], \"machine\": \"nautilus\"}").await.assert_bad_field("/machine");
    post("/fk/batch", "{\"joints\": [[1,2,3}").await.assert_problem(400, "bad_json");
    let empty = post("/ik/batch", "{\"poses\": []}").await;
    assert_eq!(empty.json["joints"], json!([]));
}
