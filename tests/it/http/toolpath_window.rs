//! `/toolpath/window`: the values of a parameter with which the machine can run a program.

use serde_json::{Value, json};

use super::table::with;
use super::{get_from, json_request, post, send_to, service};
use crate::cli::verne;

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

/// A line with an inclined end.
fn line() -> Value {
    json!({"program": {"points": [[-100, 0, 300, 0, 0, 1], [100, 30, 300, 0.2, 0.1, 1]]}, "tool_length": 100})
}

/// The verdict of /toolpath with a value of a parameter.
async fn verdict(parameter: &str, value: f64) -> Value {
    let changed = match parameter.strip_prefix("setup.") {
        Some(axis) => json!({"setup": {axis: value}}),
        None => json!({parameter: value}),
    };
    post("/toolpath", with(line(), changed)).await.json["verdict"].clone()
}

#[tokio::test]
async fn the_ends_are_those_of_the_verdict() {
    for (parameter, from, to) in [("tool_length", 0, 1000), ("setup.x", -600, 600), ("setup.a", -120, 120)] {
        let asked = with(line(), json!({"parameter": parameter, "from": from, "to": to}));
        let answer = post("/toolpath/window", asked).await;
        assert_eq!(answer.status, 200, "{}", answer.json);
        let intervals = answer.json["intervals"].as_array().unwrap();
        assert_eq!(intervals.len(), 1, "{}", answer.json);
        let mut limits = 0;
        for (i, side) in ["from", "to"].into_iter().enumerate() {
            let (end, what) = (number(&intervals[0][side]), &intervals[0]["ends"][i]);
            assert_eq!(verdict(parameter, end).await, "ok", "{parameter} {end}");
            if what["kind"] == "limit" {
                limits += 1;
                let outside = end + [-1e-6, 1e-6][i];
                assert_eq!(verdict(parameter, outside).await, "fails", "{parameter} {outside}");
                assert!(
                    what["constraint"].is_string()
                        && what["element"].is_string()
                        && number(&what["line"]) > 0.0
                );
            } else {
                assert_eq!(what, &json!({"kind": "bound"}));
            }
        }
        assert!(limits > 0, "{}", answer.json);
    }
}

#[tokio::test]
async fn the_parameters_own_value_takes_no_part_and_the_answer_is_stored() {
    let service = service().await;
    let fields = json!({"parameter": "tool_length", "from": 50, "to": 60});
    let mut bodies = Vec::new();
    for length in [100, 300] {
        let asked = with(with(line(), fields.clone()), json!({"tool_length": length}));
        let request = json_request(axum::http::Method::POST, "/toolpath/window", asked);
        let answer = send_to(service.clone(), request).await;
        assert_eq!(answer.status, 200, "{}", answer.json);
        bodies.push(answer);
    }
    assert_eq!(bodies[0].bytes, bodies[1].bytes);
    let answer = &bodies[0].json;
    let ends = [json!({"kind": "bound"}), json!({"kind": "bound"})];
    assert_eq!(answer["intervals"][0]["ends"], json!(ends));
    assert_eq!(answer["unit"], "mm");
    let again = get_from(&service, answer["links"]["self"].as_str().unwrap(), &[]).await;
    assert_eq!(again.bytes, bodies[0].bytes);
    let rows = format!("{}/rows.json", answer["links"]["self"].as_str().unwrap());
    get_from(&service, &rows, &[]).await.assert_problem(404, "toolpath_not_found");
}

#[tokio::test]
async fn no_value_is_an_empty_list_with_the_nearest_value() {
    let asked = with(line(), json!({"parameter": "setup.z", "from": 2000, "to": 2100}));
    let answer = post("/toolpath/window", asked).await.json;
    assert_eq!(answer["intervals"], json!([]));
    assert!(number(&answer["nearest"]["margin"]["margin"]) < 0.0, "{answer}");
}

#[tokio::test]
async fn fields_that_cannot_be_used_are_named() {
    let length = json!({"parameter": "tool_length", "from": 0, "to": 100});
    let refused = [
        (json!({"parameter": "tool_length"}), vec!["/from", "/to"]),
        (json!({"parameter": "tool_length", "from": -1, "to": 5}), vec!["/from"]),
        (json!({"parameter": "setup.x", "from": 5, "to": 5}), vec!["/to"]),
        (json!({"parameter": "setup.q", "from": 0, "to": 5}), vec!["/parameter"]),
        (json!({"parameter": "setup.c", "from": 0, "to": 40000}), vec!["/to"]),
        (with(length.clone(), json!({"tool_length": {"1": 100}})), vec!["/tool_length"]),
        (with(length, json!({"width": 1})), vec!["/width"]),
    ];
    for (fields, pointers) in refused {
        let answer = post("/toolpath/window", with(line(), fields.clone())).await;
        answer.assert_problem(422, "invalid_request");
        let found: Vec<_> =
            answer.json["errors"].as_array().unwrap().iter().map(|error| &error["pointer"]).collect();
        assert_eq!(json!(found), json!(pointers), "{fields}");
    }
}

#[tokio::test]
async fn the_command_line_finds_the_same() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("line.csv");
    std::fs::write(&file, "x,y,z\n-100,0,300\n100,30,300\n").unwrap();
    let line = format!("toolpath-window {} --parameter tool_length --from 0 --to 1000", file.display());
    let found: Value = serde_json::from_str(&verne(&line).unwrap()).unwrap();
    let asked = json!({"program": {"points": [[-100, 0, 300], [100, 30, 300]]}, "parameter": "tool_length",
                       "from": 0, "to": 1000});
    let answer = post("/toolpath/window", asked).await.json;
    assert_eq!(found["intervals"][0]["to"], answer["intervals"][0]["to"], "{found}");
}
