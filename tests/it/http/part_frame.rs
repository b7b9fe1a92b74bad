//! The whole machine: orientations by angles and by axis, and the rotation that is free.

use serde_json::json;

use super::{get, post};

fn number(value: &serde_json::Value) -> f64 {
    value.as_f64().unwrap()
}

#[tokio::test]
async fn joints_of_a_part_pose_bring_it_back() {
    let uri = "/ik?x=100&y=50&z=150&phi1=30&phi2=40&tool_length=50";
    let joints = get(uri).await.solutions()[0]["joints"].clone();
    let body = json!({"joints": joints, "tool_length": 50});
    let reply = post("/fk", body).await;
    let part = &reply.solutions()[0]["part"];
    for (field, value) in [("x", 100.0), ("y", 50.0), ("z", 150.0), ("phi1", 30.0), ("phi2", 40.0)] {
        assert!((number(&part[field]) - value).abs() < 1e-9, "{part}");
    }
}

#[tokio::test]
async fn an_axis_is_solved_in_both_preimages() {
    let (phi1, phi2) = (30_f64.to_radians(), 40_f64.to_radians());
    let axis = [phi1.sin() * phi2.sin(), -phi1.sin() * phi2.cos(), phi1.cos()];
    let body =
        json!({"pose": {"x": 100, "y": 50, "z": 150, "axis": axis}, "tool_length": 50, "solutions": "all"});
    let both = post("/ik", body).await;
    let mut count = 0;
    for (phi1, phi2) in [(30.0, 40.0), (-30.0, -140.0)] {
        let one =
            get(&format!("/ik?x=100&y=50&z=150&phi1={phi1}&phi2={phi2}&tool_length=50&solutions=all")).await;
        count += one.solutions().len();
        let with_this =
            both.solutions().iter().filter(|found| (number(&found["part"]["phi1"]) - phi1).abs() < 1e-9);
        assert_eq!(with_this.count(), one.solutions().len());
    }
    assert_eq!(both.solutions().len(), count);
    for solution in both.solutions() {
        for (found, wanted) in solution["part"]["axis"].as_array().unwrap().iter().zip(axis) {
            assert!((number(found) - wanted).abs() < 1e-12);
        }
    }
    let mut labels: Vec<_> = both.solutions().iter().map(|solution| solution["mode"].to_string()).collect();
    labels.sort();
    labels.dedup();
    assert_eq!(labels.len(), count, "labels with their index are unique in an answer");
}

#[tokio::test]
async fn the_rotation_along_the_tables_axis_is_free() {
    let pose = json!({"x": 100, "y": 50, "z": 150, "axis": [0, 0, 1]});
    let free = post("/ik", json!({"pose": pose, "tool_length": 50})).await;
    assert_eq!(free.json["free"], json!(["phi2"]));
    assert_eq!(number(&free.solutions()[0]["joints"]["theta2"]), 0.0);

    let near = json!({"rho": [500, 500, 500], "theta2": 90});
    let held = post("/ik", json!({"pose": pose, "tool_length": 50, "near": near})).await;
    assert_eq!(held.json["free"], json!(["phi2"]));
    assert!((number(&held.solutions()[0]["joints"]["theta2"]) - 90.0).abs() < 1e-9);

    let settled = get("/ik?x=100&y=50&z=150&axis=0,0,1&phi2=-90&tool_length=50").await;
    assert!(settled.json.get("free").is_none());
    assert_eq!(settled.json["solutions"], held.json["solutions"]);

    let by_angle = get("/ik?x=100&y=50&z=150&phi1=0&tool_length=50").await;
    assert_eq!(by_angle.json, free.json);
}

#[tokio::test]
async fn an_orientation_says_neither_too_little_nor_too_much() {
    get("/ik?x=1&y=2&z=3&phi1=30&axis=0,0,1").await.assert_bad_field("/query/axis");
    get("/ik?x=1&y=2&z=3&axis=0,0,0").await.assert_bad_field("/query/axis");
    get("/ik?x=1&y=2&z=3&axis=0,1,1&phi2=3").await.assert_bad_field("/query/phi2");
    get("/ik?frame=tool&x=1&y=2&z=3&phi1=3").await.assert_bad_field("/query/phi1");
    post("/ik", json!({"frame": "platform", "pose": {"x": 1, "y": 2, "z": 3, "phi2": 0}}))
        .await
        .assert_bad_field("/pose/phi2");
}

#[tokio::test]
async fn angles_that_are_left_out_are_zero() {
    let settled = get("/ik?x=100&y=50&z=150&phi1=0&phi2=0&tool_length=50").await;
    let open = get("/ik?x=100&y=50&z=150&tool_length=50").await;
    assert_eq!(open.json["free"], json!(["phi2"]));
    assert_eq!(open.solutions(), settled.solutions());
    let pose = json!({"x": 100, "y": 50, "z": 150});
    assert_eq!(post("/ik", json!({"pose": pose, "tool_length": 50})).await.json, open.json);
    for (short, whole) in [("phi1=30", "phi1=30&phi2=0"), ("phi2=40", "phi1=0&phi2=40")] {
        let [short, whole] =
            [short, whole].map(|angles| format!("/ik?x=100&y=50&z=150&{angles}&tool_length=50"));
        assert_eq!(get(&short).await.json, get(&whole).await.json, "{short}");
        assert!(!get(&short).await.solutions().is_empty());
    }
}
