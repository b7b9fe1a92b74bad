//! Poses in the part frame: orientations by angles and by axis, the free rotation, windings.

use serde_json::json;

use super::{get, post};

fn number(value: &serde_json::Value) -> f64 {
    value.as_f64().unwrap()
}

#[tokio::test]
async fn forward_of_the_joints_returns_the_part_pose() {
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
async fn the_rotation_about_the_table_axis_is_free() {
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
async fn near_chooses_the_nearest_winding_within_the_range() {
    let theta2 = async |orientation: &str, near: &str| {
        let uri = format!("/ik?x=100&y=50&z=150&tool_length=50&{orientation}&near_joints=500,500,500,{near}");
        number(&get(&uri).await.solutions()[0]["joints"]["theta2"])
    };
    assert_eq!(theta2("phi1=10&phi2=10", "0,350").await, 350.0);
    assert_eq!(theta2("phi1=10&phi2=10", "0,-20").await, -10.0);
    assert_eq!(theta2("phi1=10&phi2=-10", "0,-340").await, -350.0);
    // The range ends at 360°: no nearer winding is admissible.
    assert_eq!(theta2("phi1=10&phi2=10", "0,720").await, 350.0);
    assert_eq!(theta2("axis=0,0,1", "0,350").await, 350.0);

    let mut machine = get("/machines/verne").await.json["definition"].clone();
    machine["limits"]["tilt"] = json!([-400, 400]);
    let near = json!({"rho": [500, 500, 500], "theta1": 340});
    let pose = json!({"x": 100, "y": 0, "z": 150, "phi1": 10, "phi2": 0});
    let reply = post("/ik", json!({"machine": machine, "pose": pose, "tool_length": 50, "near": near})).await;
    assert!((number(&reply.solutions()[0]["joints"]["theta1"]) - 350.0).abs() < 2.0, "{}", reply.json);
}

#[tokio::test]
async fn windings_add_no_rounding_error() {
    let plain = get("/ik?x=100&y=50&z=150&tool_length=50&phi1=10&phi2=10").await;
    let turned = get("/ik?x=100&y=50&z=150&tool_length=50&phi1=370&phi2=370").await;
    assert_eq!(number(&turned.solutions()[0]["joints"]["theta2"]), -10.0);
    assert_eq!(turned.solutions()[0]["joints"], plain.solutions()[0]["joints"]);
    let rows = json!({"tool_length": 50, "poses": [[100, 50, 150, 10, 10], [100, 50, 150, 370, 370]]});
    let batch = post("/ik/batch", rows).await.json;
    assert_eq!(batch["joints"][0], batch["joints"][1]);
    assert_eq!(batch["joints"][1][4], -10.0);
}

#[tokio::test]
async fn an_axis_can_have_any_length_and_rounding_noise_is_ignored() {
    let ask = async |axis: &str| get(&format!("/ik?x=100&y=50&z=150&tool_length=50&axis={axis}")).await;
    let plain = ask("1,1,3").await;
    for axis in ["1e200,1e200,3e200", "1e-200,1e-200,3e-200", "2e7,2e7,6e7"] {
        for (scaled, plain) in ask(axis).await.solutions().iter().zip(plain.solutions()) {
            for joint in ["theta1", "theta2"] {
                let off = number(&scaled["joints"][joint]) - number(&plain["joints"][joint]);
                assert!(off.abs() < 1e-9, "{axis}: {scaled}");
            }
        }
    }
    let seam = ask("0,1,3").await;
    for axis in ["-0.0,1,3", "1e-17,1,3", "-1e-17,1,3"] {
        assert_eq!(ask(axis).await.json["solutions"], seam.json["solutions"], "{axis}");
    }
    let pole = ask("0,0,1").await;
    for axis in ["1e-9,0,1", "0,-1e-7,1", "-0.0,-0.0,5"] {
        assert_eq!(ask(axis).await.json, pole.json, "{axis}");
    }
    ask("inf,0,1").await.assert_bad_field("/query/axis");
}

#[tokio::test]
async fn lengths_out_of_proportion_to_the_machine_are_refused() {
    let mut machine = get("/machines/verne").await.json["definition"].clone();
    for length in machine["geometry"].as_object_mut().unwrap().values_mut() {
        *length = json!(0.01 * number(length));
    }
    let body = |z: f64| json!({"machine": machine, "frame": "platform", "pose": {"x": 0, "y": 0, "z": z}});
    assert_eq!(post("/ik", body(1e5)).await.solutions().len(), 1);
    let refused = post("/ik", body(1.1e5)).await;
    refused.assert_bad_field("/pose/z");
    assert!(refused.json["errors"][0]["detail"].as_str().unwrap().contains("longest dimension"));
    let joints = json!({"machine": machine, "joints": {"rho": [5, 1.1e5, 5]}});
    post("/fk", joints).await.assert_bad_field("/joints/rho/1");
    let points = json!({"machine": machine, "points": [[0, 0, 12], [0, 0, 1.1e5]]});
    let contains = post("/workspace/contains", points).await.json;
    assert_eq!(contains["counts"]["invalid"], 1, "{contains}");
    let rows = json!({"machine": machine, "frame": "platform", "poses": [[0, 0, 12], [0, 0, 1.1e5]]});
    assert_eq!(post("/ik/batch", rows).await.json["status"][1], "invalid");
}

#[tokio::test]
async fn incomplete_and_contradictory_orientations_are_refused() {
    get("/ik?x=1&y=2&z=3&phi1=30&axis=0,0,1").await.assert_bad_field("/query/axis");
    get("/ik?x=1&y=2&z=3&axis=0,0,0").await.assert_bad_field("/query/axis");
    get("/ik?x=1&y=2&z=3&axis=0,1,1&phi2=3").await.assert_bad_field("/query/phi2");
    get("/ik?frame=tool&x=1&y=2&z=3&phi1=3").await.assert_bad_field("/query/phi1");
    post("/ik", json!({"frame": "platform", "pose": {"x": 1, "y": 2, "z": 3, "phi2": 0}}))
        .await
        .assert_bad_field("/pose/phi2");
}

#[tokio::test]
async fn omitted_angles_are_zero() {
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
