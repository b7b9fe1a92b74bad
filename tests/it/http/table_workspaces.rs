//! The table as a limit of workspaces, families and dexterity maps.

use axum::http::Method;
use serde_json::{Value, json};

use super::table::{CHECKED, UNCHECKED, machine, with};
use super::{get_from, json_request, post, send_to, service};

#[tokio::test]
async fn a_workspace_ends_at_the_table() {
    let part = json!({"kind": "part", "tool_length": 400, "tolerance": 5});
    let before = post("/workspace", &part).await.json;
    let after = post("/workspace", with(part.clone(), json!({"table_clearance": 0}))).await.json;
    assert!(before["bounds"]["min"][2].as_f64().unwrap() < -300.0);
    assert!(after["bounds"]["min"][2].as_f64().unwrap().abs() < 1e-6, "{}", after["bounds"]);
    assert!(after["volume"].as_f64().unwrap() < 0.9 * before["volume"].as_f64().unwrap());
    assert_ne!(after["id"], before["id"]);
    assert_eq!(after["not_checked"], json!(CHECKED));
    assert_eq!(after["request"]["table_clearance"], 0.0);
    // Without a clearance the radius has no effect, and the question is the one that it always was.
    let idle = post("/workspace", with(part.clone(), json!({"tool_radius": 30}))).await.json;
    assert_eq!((&idle["id"], &idle["request"]), (&before["id"], &before["request"]));
    assert_eq!(before["request"].get("table_clearance"), None);
    // The machine's own limit is filled in.
    let own = post("/workspace", with(part.clone(), json!({"machine": machine(&json!(0))}))).await.json;
    assert_eq!(own["volume"], after["volume"]);
    assert_eq!(own["request"], after["request"]);
    assert_ne!(own["machine"]["hash"], after["machine"]["hash"]);
    let platform = json!({"machine": machine(&json!(0)), "tolerance": 20});
    assert_eq!(post("/workspace", platform).await.json["not_checked"], json!(UNCHECKED));
}

#[tokio::test]
async fn meshes_and_slices_end_at_the_table() {
    let service = service().await;
    let question = json!({"kind": "part", "tool_length": 400, "tolerance": 5, "table_clearance": 20});
    let asked = json_request(Method::POST, "/workspace", &question);
    let found = send_to(service.clone(), asked).await.json;
    let path = found["links"]["self"].as_str().unwrap();
    let mesh = get_from(&service, &format!("{path}/mesh?format=json"), &[]).await.json["extras"].clone();
    let names: Vec<&str> = mesh["constraints"]
        .as_array()
        .unwrap()
        .iter()
        .map(|swatch| swatch["name"].as_str().unwrap())
        .collect();
    assert!(names.contains(&"table_clearance tool"), "{names:?}");
    assert_eq!(mesh["not_checked"], json!(CHECKED));
    for (z, empty) in [(10, true), (30, false)] {
        let slice = get_from(&service, &format!("{path}/slice?z={z}"), &[]).await.json;
        assert_eq!(slice["polygons"] == json!([]), empty, "{z}");
        assert_eq!(slice["not_checked"], json!(CHECKED));
    }
}

#[tokio::test]
async fn families_membership_and_dexterity_end_at_the_table() {
    let question = json!({"kind": "part", "tool_length": 400, "table_clearance": 0});
    let family =
        post("/workspace", with(question.clone(), json!({"phi1": [0, 20], "tolerance": 20}))).await.json;
    assert_eq!(family["not_checked"], json!(CHECKED));
    for member in family["members"].as_array().unwrap() {
        assert_eq!(member["request"]["table_clearance"], 0.0);
        assert!(member["bounds"]["min"][2].as_f64().unwrap() > -1.0, "{member}");
    }
    let points = json!([[0, 0, -120], [0, 0, 120], [0, 0, 0.001]]);
    let members = post("/workspace/contains", with(question, json!({"points": points}))).await.json;
    assert_eq!(members["inside"], json!([false, true, true]));
    assert_eq!(members["constraint"][0], "table_clearance");
    assert_eq!((&members["element"][0], &members["unit"][0]), (&json!("tool"), &json!("mm")));
    assert_eq!(members["not_checked"], json!(CHECKED));
    let map = json!({"phi1": {"from": -20, "to": 20}, "tool_length": 400, "cell": 150});
    let before = post("/workspace/dexterity", &map).await.json;
    let after = post("/workspace/dexterity", with(map, json!({"table_clearance": 0}))).await.json;
    assert_eq!(after["not_checked"], json!(CHECKED));
    let map = json!({"kind": "part", "tool_length": 400, "cell": 100, "tolerance": 20, "parameter_tolerances":
        {"L1": 0.01}});
    let all = post("/workspace/error-budget", &map).await.json;
    let above = post("/workspace/error-budget", with(map, json!({"table_clearance": 0}))).await.json;
    assert_eq!(above["not_checked"], json!(CHECKED));
    assert!(above["inside"].as_u64() < all["inside"].as_u64(), "{above}");
    for set in ["reachable", "dexterous"] {
        let volume = |map: &Value| map[set]["volume"].as_f64().unwrap();
        assert!(volume(&after) < 0.95 * volume(&before), "{set}: {after}");
    }
}
