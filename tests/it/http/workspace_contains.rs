//! `/workspace/contains`.

use serde_json::{Value, json};

use super::post;

#[tokio::test]
async fn membership_agrees_with_the_inverse_solution() {
    for (kind, frame) in [("platform", "platform"), ("tool", "tool"), ("part", "part")] {
        let points: Vec<[f64; 3]> = (0..200)
            .map(|i| {
                let i = f64::from(i);
                let z = if kind == "part" { 50.0 + 3.7 * i } else { 800.0 + 4.3 * i };
                [(37.0 * i) % 900.0 - 450.0, (91.0 * i) % 1300.0 - 650.0, z]
            })
            .collect();
        let question = json!({"kind": kind, "tool_length": 50, "phi1": 5, "points": points});
        let answer = post("/workspace/contains", question).await.json;
        let poses: Vec<Vec<f64>> = points
            .iter()
            .map(|point| if kind == "part" { [&point[..], &[5.0, 0.0]].concat() } else { point.to_vec() })
            .collect();
        let batch = post("/ik/batch", json!({"frame": frame, "tool_length": 50, "poses": poses})).await.json;
        let mut inside = 0;
        for i in 0..points.len() {
            assert_eq!(answer["inside"][i] == true, batch["status"][i] == "ok", "{kind} {:?}", points[i]);
            let margin = answer["margin"][i].as_f64().unwrap();
            if answer["inside"][i] == true {
                inside += 1;
                assert!(margin >= 0.0);
            } else {
                assert!(
                    (margin - batch["margin"][i].as_f64().unwrap()).abs() < 1e-9,
                    "{kind} {:?}",
                    points[i]
                );
                for column in ["constraint", "element"] {
                    assert_eq!(answer[column][i], batch[column][i]);
                }
            }
        }
        assert!(inside > 20 && inside < 180, "{inside}");
        assert_eq!(answer["counts"], json!({"inside": inside, "outside": 200 - inside, "invalid": 0}));
    }
}

#[tokio::test]
async fn an_invalid_point_does_not_affect_the_others() {
    let points = json!([[0, 0, 1200], null, [1, 2], [0, 0, 1e9], ["a", 1, 2], [0, 0, 9000], [0, 0, 1200]]);
    let answer = post("/workspace/contains", json!({"points": points})).await.json;
    assert_eq!(answer["inside"], json!([true, null, null, null, null, false, true]));
    assert_eq!(answer["counts"], json!({"inside": 2, "outside": 1, "invalid": 4}));
    assert_eq!(answer["margin"][0], answer["margin"][6]);
    let rows: Vec<&Value> = answer["errors"].as_array().unwrap().iter().map(|error| &error["row"]).collect();
    assert_eq!(rows, [1, 2, 3, 4]);
    assert_eq!(answer["unit"][5], "mm");
    let none = post("/workspace/contains", json!({"points": []})).await;
    assert_eq!((none.status.as_u16(), &none.json["inside"]), (200, &json!([])));
}

#[tokio::test]
async fn a_problem_names_the_field() {
    for (question, pointer) in [
        (json!({}), "/points"),
        (json!({"points": 3}), "/points"),
        (json!({"points": [], "kind": "nautilus"}), "/kind"),
        (json!({"points": [], "phi1": 1e9}), "/phi1"),
        (json!({"points": [], "tolerance": 1}), "/tolerance"),
    ] {
        post("/workspace/contains", question).await.assert_bad_field(pointer);
    }
    let many = json!({"points": vec![[0, 0, 1200]; 2001]});
    post("/workspace/contains", many).await.assert_problem(413, "too_many_rows");
}
