//! `/fk` and `/ik`: the examples of the paper, filters, order, labels, reasons.

use serde_json::{Value, json};

use super::{get, post};

const FIG_5: &str = "/ik?frame=platform&x=-240&y=-86&z=1000";

fn working(solutions: &[Value]) -> usize {
    solutions.iter().filter(|solution| solution["working"] == true).count()
}

#[tokio::test]
async fn figure_5_has_sixteen_solutions_one_working() {
    let reply = get(&format!("{FIG_5}&solutions=all")).await;
    let solutions = reply.solutions();
    assert_eq!(solutions.len(), 16);
    assert_eq!(working(solutions), 1);
    assert_eq!(solutions[0]["working"], true, "the working solution comes first");
    let mut labels: Vec<_> = solutions.iter().map(|solution| solution["mode"].to_string()).collect();
    labels.sort();
    labels.dedup();
    assert_eq!(labels.len(), 16, "sixteen different labels");
}

#[tokio::test]
async fn figure_6_has_four_assembly_modes_one_working() {
    let reply = get("/fk?rho=674,685,250&solutions=all").await;
    assert_eq!(reply.solutions().len(), 4);
    assert_eq!(working(reply.solutions()), 1);
    assert!(reply.solutions().iter().all(|solution| solution.get("part").is_none()));
    assert!(reply.solutions().iter().all(|solution| solution["residual"].as_f64().unwrap() < 1e-9));
}

#[tokio::test]
async fn get_and_post_give_the_same_answer() {
    let by_query = get("/fk?rho=674,685,250&theta1=10&theta2=-20&tool_length=50&solutions=all").await;
    let body = json!({"joints": {"rho": [674, 685, 250], "theta1": 10, "theta2": -20}, "tool_length": 50,
                      "solutions": "all"});
    assert_eq!(by_query.json, post("/fk", body).await.json);
    let body = json!({"frame": "platform", "pose": {"x": -240, "y": -86, "z": 1000}, "machine": "verne"});
    assert_eq!(get(FIG_5).await.json, post("/ik", body).await.json);
}

#[tokio::test]
async fn forward_of_inverse_returns_the_pose() {
    let inverse = get(FIG_5).await;
    let rho = inverse.solutions()[0]["joints"]["rho"].as_array().unwrap().clone();
    let rho: Vec<_> = rho.iter().map(ToString::to_string).collect();
    let forward = get(&format!("/fk?rho={}", rho.join(","))).await;
    let platform = &forward.solutions()[0]["platform"];
    for (axis, value) in [("x", -240.0), ("y", -86.0), ("z", 1000.0)] {
        assert!((platform[axis].as_f64().unwrap() - value).abs() < 1e-9, "{platform}");
    }
}

#[tokio::test]
async fn the_tool_end_is_at_the_tool_length_from_the_platform() {
    let reply = get(&format!("{FIG_5}&tool_length=50")).await;
    let solution = &reply.solutions()[0];
    let alpha = solution["platform"]["alpha"].as_f64().unwrap().to_radians();
    let tip = -86.0 - 50.0 * alpha.sin();
    assert!((solution["tool"]["y"].as_f64().unwrap() - tip).abs() < 1e-9);
    let uri = format!("/ik?frame=tool&x=-240&y={tip}&z={}&tool_length=50", 1000.0 + 50.0 * alpha.cos());
    let back = get(&uri).await;
    assert!((back.solutions()[0]["platform"]["z"].as_f64().unwrap() - 1000.0).abs() < 1e-9);
}

#[tokio::test]
async fn the_feasible_filter_hides_infeasible_solutions_and_names_the_limit() {
    let high = "/ik?frame=platform&x=0&y=0&z=700";
    let working = get(high).await;
    assert_eq!(working.solutions().len(), 1);
    assert_eq!(working.solutions()[0]["feasible"], false);
    let feasible = get(&format!("{high}&solutions=feasible")).await;
    assert!(feasible.solutions().is_empty());
    assert_eq!(feasible.json["reason"], "infeasible");
    assert_eq!(feasible.json["constraint"], working.solutions()[0]["margins"]["worst"]);
    assert_eq!(feasible.json["constraint"]["constraint"], "stroke");
    assert_eq!(feasible.json["constraint"]["unit"], "mm");
    assert!(feasible.json["constraint"]["value"].as_f64().unwrap() < 0.0);
}

#[tokio::test]
async fn an_unreachable_pose_is_answered_with_200() {
    let reply = get("/ik?frame=platform&x=3000&y=0&z=1000&solutions=all").await;
    assert!(reply.solutions().is_empty());
    assert_eq!(reply.json["reason"], "unreachable");
    assert_eq!(reply.json["constraint"]["constraint"], "leg_length");
    assert_eq!(reply.json["machine"]["name"], "verne");
}

#[tokio::test]
async fn margins_name_every_constraint() {
    let reply = get("/fk?rho=674,685,250&theta1=0&theta2=0").await;
    let margins = reply.solutions()[0]["margins"].as_object().unwrap();
    let names = [
        "stroke",
        "leg_length",
        "serial_singularity",
        "parallel_singularity",
        "slider_joint",
        "platform_joint",
        "rod_crossing",
        "rod_interference",
        "tilt",
        "rotary",
        "worst",
    ];
    assert_eq!(margins.keys().map(String::as_str).collect::<Vec<_>>(), names);
    for rods in ["serial_singularity", "slider_joint", "platform_joint"] {
        assert_eq!(margins[rods].as_array().unwrap().len(), 6);
    }
    assert_eq!(margins["tilt"], json!([90.0, 90.0]));
    let conditioning = &reply.solutions()[0]["conditioning"];
    assert_eq!(conditioning["serial"].as_array().unwrap().len(), 6);
    assert!(conditioning["condition_number"].as_f64().unwrap() >= 1.0);
}

#[tokio::test]
async fn solutions_are_sorted_by_distance_to_near() {
    let all = get(&format!("{FIG_5}&solutions=all")).await;
    for wanted in all.solutions() {
        let rho = &wanted["joints"]["rho"];
        let body = json!({"frame": "platform", "pose": {"x": -240, "y": -86, "z": 1000}, "solutions": "all",
                          "near": {"rho": rho}});
        let sorted = post("/ik", body).await;
        assert_eq!(&sorted.solutions()[0]["joints"]["rho"], rho);
        assert_eq!(sorted.solutions()[0]["mode"], wanted["mode"], "labels do not depend on the order");
    }
    let alpha = get(&format!("{FIG_5}&solutions=all&near_pose=-240,-86,1000,-171")).await;
    let first = alpha.solutions()[0]["platform"]["alpha"].as_f64().unwrap();
    assert!((first + 170.447).abs() < 1e-3, "{first}");
}
