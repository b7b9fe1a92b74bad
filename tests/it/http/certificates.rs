//! Certified answers of `/fk` and `/ik`: boxes, completeness, and the cases in which something is not proved.

use serde_json::{Value, json};

use super::{Reply, get, post};

const FIG_5: &str = "/ik?frame=platform&x=-240&y=-86&z=1000&certified=true";

fn completeness(reply: &Reply) -> &Value {
    &reply.json["completeness"]
}

/// Every number of a solution is within its bounds, which are narrow.
fn assert_proved(solution: &Value) {
    let certificate = &solution["certificate"];
    assert_eq!(certificate["proved"], true, "{certificate}");
    let found = &certificate["box"];
    let mut coordinates: Vec<(&Value, &Value)> = ["x", "y", "z", "alpha"]
        .into_iter()
        .map(|name| (&solution["platform"][name], &found[name]))
        .collect();
    if let Some(rho) = solution["joints"]["rho"].as_array() {
        coordinates.extend(rho.iter().zip(found["rho"].as_array().unwrap()));
    }
    for (number, bounds) in coordinates {
        let [number, low, high] = [number, &bounds[0], &bounds[1]].map(|value| value.as_f64().unwrap());
        assert!(low <= number && number <= high && high - low < 1e-8, "{number} in {bounds}");
    }
}

fn assert_all_proved(reply: &Reply, count: usize) {
    assert_eq!(reply.solutions().len(), count);
    reply.solutions().iter().for_each(assert_proved);
    assert_eq!(*completeness(reply), json!({"complete": true}));
}

#[tokio::test]
async fn the_sixteen_solutions_of_figure_5_are_all_that_there_are() {
    assert_all_proved(&get(&format!("{FIG_5}&solutions=all")).await, 16);
    assert_all_proved(&get(FIG_5).await, 1);
    let none_feasible = get("/ik?frame=platform&x=0&y=0&z=700&certified=true&solutions=feasible").await;
    assert_all_proved(&none_feasible, 0);
}

#[tokio::test]
async fn the_four_assembly_modes_of_figure_6_are_all_that_there_are() {
    let reply = get("/fk?rho=674,685,250&solutions=all&certified=true").await;
    assert_all_proved(&reply, 4);
    assert!(reply.solutions()[0]["certificate"]["box"].get("rho").is_none(), "the sliders are given");
    let body = json!({"joints": {"rho": [674, 685, 250]}, "solutions": "all", "certified": true});
    assert_eq!(post("/fk", body).await.json, reply.json);
}

#[tokio::test]
async fn an_answer_that_is_not_certified_has_no_proof() {
    let certified = get(FIG_5).await.json;
    let mut without = certified.clone();
    without.as_object_mut().unwrap().remove("completeness");
    without["solutions"][0].as_object_mut().unwrap().remove("certificate");
    assert_eq!(get(&FIG_5.replace("&certified=true", "")).await.json, without);
    assert_eq!(get(&FIG_5.replace("true", "false")).await.json, without);
}

#[tokio::test]
async fn tools_and_orientations_are_certified() {
    assert_all_proved(&get("/ik?frame=tool&x=50&y=120&z=1300&tool_length=150&certified=true").await, 1);
    let part = "/ik?x=100&y=50&z=300&tool_length=150&certified=true";
    assert_all_proved(&get(&format!("{part}&phi1=20&phi2=30&solutions=all")).await, 16);
    let turned = get(&format!("{part}&phi1=380&phi2=-690")).await;
    assert_all_proved(&turned, 1);
    // Both orientations with the axis.
    let both = get(&format!("{part}&axis=0.3,-0.4,1.2&solutions=all")).await;
    assert_eq!(*completeness(&both), json!({"complete": true}));
    assert!(both.solutions().len() > 16);
    both.solutions().iter().for_each(assert_proved);
}

#[tokio::test]
async fn a_free_phi2_leaves_other_solutions() {
    let vertical = "/ik?x=100&y=50&z=300&certified=true";
    for free in [vertical.to_owned(), format!("{vertical}&axis=0,0,1")] {
        let reply = get(&free).await;
        assert_eq!(reply.json["free"], json!(["phi2"]));
        assert_eq!(*completeness(&reply), json!({"complete": false, "reason": "free_phi2"}));
        reply.solutions().iter().for_each(assert_proved);
    }
    for given in [format!("{vertical}&phi2=15"), format!("{vertical}&axis=0,0,1&phi2=15")] {
        assert_all_proved(&get(&given).await, 1);
    }
}

#[tokio::test]
async fn a_pose_out_of_reach_is_proved_to_have_no_solution() {
    let reply = get("/ik?frame=platform&x=3000&y=0&z=1000&solutions=all&certified=true").await;
    assert_eq!(reply.json["reason"], "unreachable");
    assert_all_proved(&reply, 0);
}

#[tokio::test]
async fn merged_solutions_are_not_proved() {
    // Legs II and III level: both sides of each leg are one.
    let geometry = get("/machines/verne").await.json["definition"]["geometry"].clone();
    let number = |name: &str| geometry[name].as_f64().unwrap();
    let reach = (number("L2").powi(2) - (number("R2") - number("r4")).powi(2)).sqrt();
    let x = reach - (number("D2") - number("d2"));
    let reply = get(&format!("/ik?frame=platform&x={x}&y=0&z=1000&solutions=all&certified=true")).await;
    let merged: Vec<_> = reply.solutions().iter().filter(|solution| solution["merged"] == true).collect();
    assert!(!merged.is_empty());
    for solution in merged {
        assert_eq!(solution["certificate"], json!({"proved": false, "reason": "merged"}));
    }
    assert_eq!(*completeness(&reply), json!({"complete": false, "reason": "unproved_solution"}));
}

#[tokio::test]
async fn a_curve_of_solutions_is_not_proved() {
    let mut machine = get("/machines/verne").await.json["definition"].clone();
    let proportional = json!({"R1": 300, "r1": 100, "R2": 150, "r4": 50, "L1": 1000, "L2": 900, "L3": 900});
    for (name, length) in proportional.as_object().unwrap() {
        machine["geometry"][name] = length.clone();
    }
    let body = json!({"machine": machine, "joints": {"rho": [300, 300, 300]}, "certified": true});
    let reply = post("/fk", body).await;
    assert_eq!(reply.json["reason"], "self_motion");
    assert_eq!(*completeness(&reply), json!({"complete": false, "reason": "self_motion"}));
}

#[tokio::test]
async fn a_linear_delta_is_certified() {
    for solutions in ["working", "all"] {
        for request in
            ["/fk?rho=300,250,280", "/ik?frame=platform&x=40&y=-30&z=900", "/ik?x=20&y=10&z=100&phi2=0"]
        {
            let reply =
                get(&format!("{request}&machine=linear-delta&solutions={solutions}&certified=true")).await;
            assert!(!reply.solutions().is_empty(), "{request}");
            assert_all_proved(&reply, reply.solutions().len());
        }
    }
}

#[tokio::test]
async fn batches_are_not_certified() {
    let bodies = [("/ik/batch", "poses"), ("/fk/batch", "joints")];
    for (path, rows) in bodies {
        let refused = post(path, json!({rows: [[0, 0, 300]], "certified": true})).await;
        assert_eq!(
            (refused.status.as_u16(), &refused.json["code"]),
            (422, &json!("invalid_request")),
            "{path}"
        );
        assert!(refused.json.to_string().contains("unknown field `certified`"), "{}", refused.json);
    }
}
