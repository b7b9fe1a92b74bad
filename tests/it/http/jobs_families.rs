//! POST /workspace with lists: families of workspaces.

use axum::Router;
use axum::http::StatusCode;
use serde_json::{Value, json};

use super::jobs::{metric, one_core};
use super::workspace::ask;
use super::{get_from, json_request, opened, post, send_to, service};

fn numbers(table: &Value, name: &str) -> Vec<f64> {
    let members = table["members"].as_array().unwrap().iter();
    members.map(|member| member["request"][name].as_f64().unwrap()).collect()
}

async fn table(service: &Router, question: Value) -> Value {
    let reply = ask(service, question).await;
    assert_eq!(reply.status, StatusCode::OK, "{}", reply.json);
    reply.json
}

#[tokio::test]
async fn members_are_ordered_with_phi2_fastest() {
    let service = service().await;
    let steps = json!({"from": 10, "to": 30, "step": 10});
    let question =
        json!({"kind": "part", "tool_length": steps, "phi1": 5, "phi2": [-20, 0], "tolerance": 100});
    let found = table(&service, question).await;
    assert_eq!(numbers(&found, "tool_length"), [10.0, 10.0, 20.0, 20.0, 30.0, 30.0]);
    assert_eq!(numbers(&found, "phi1"), [5.0; 6]);
    assert_eq!(numbers(&found, "phi2"), [-20.0, 0.0, -20.0, 0.0, -20.0, 0.0]);
    let request = json!({
        "kind": "part", "tool_length": [10.0, 20.0, 30.0], "phi1": [5.0], "phi2": [-20.0, 0.0], "tolerance": 100.0
    });
    assert_eq!(found["request"], request);
    let started = metric(&service, "verne_jobs_started_total").await;
    let written_out = table(&service, request.clone()).await;
    assert_eq!(written_out, found, "steps and their list are one question");
    let kept = get_from(&service, found["links"]["self"].as_str().unwrap(), &[]).await.json;
    assert_eq!(kept, found);
    assert_eq!(metric(&service, "verne_jobs_started_total").await, started);
}

#[tokio::test]
async fn every_member_is_stored_as_its_own_result() {
    let service = service().await;
    let found = table(&service, json!({"kind": "tool", "tool_length": [50, 150], "tolerance": 20})).await;
    let started = metric(&service, "verne_jobs_started_total").await;
    for (member, tool_length) in found["members"].as_array().unwrap().iter().zip([50, 150]) {
        let path = format!("/workspace/{}", member["id"].as_str().unwrap());
        let question = json!({"kind": "tool", "tool_length": tool_length, "tolerance": 20});
        let alone = ask(&super::service().await, question.clone()).await;
        assert_eq!(get_from(&service, &path, &[]).await.bytes, alone.bytes);
        assert_eq!(ask(&service, question).await.bytes, alone.bytes);
        for figure in ["volume", "volume_error", "area", "bounds", "vertices", "triangles", "folded"] {
            assert_eq!(member[figure], alone.json[figure], "{figure}");
        }
        assert_eq!(get_from(&service, &format!("{path}/mesh"), &[]).await.status, StatusCode::OK);
        assert_eq!(get_from(&service, &format!("{path}/slice?z=1200"), &[]).await.status, StatusCode::OK);
    }
    assert_eq!(metric(&service, "verne_jobs_started_total").await, started, "no member is computed again");
}

#[tokio::test]
async fn an_earlier_result_is_reused_as_a_member() {
    let service = opened(&one_core()).await;
    let alone = ask(&service, json!({"kind": "tool", "tool_length": 50, "tolerance": 20})).await.json;
    let found = table(&service, json!({"kind": "tool", "tool_length": [50], "tolerance": 20})).await;
    assert_eq!(found["members"][0]["id"], alone["id"]);
    assert_ne!(found["id"], alone["id"], "a list of one is a table");
}

#[tokio::test]
async fn families_of_different_lists_have_different_ids() {
    let service = service().await;
    for [one, other] in [
        [json!({"kind": "platform", "tool_length": [50]}), json!({"kind": "platform", "tool_length": [60]})],
        [
            json!({"kind": "part", "tool_length": [5, 5], "phi1": 0}),
            json!({"kind": "part", "tool_length": 5, "phi1": [0, 0]}),
        ],
    ] {
        let coarse = |mut question: Value| {
            question["tolerance"] = 100.into();
            question
        };
        let [one, other] = [table(&service, coarse(one)).await, table(&service, coarse(other)).await];
        assert_eq!(one["members"], other["members"]);
        assert_ne!(one["request"], other["request"]);
        assert_ne!(one["id"], other["id"]);
    }
}

#[tokio::test]
async fn a_problem_names_the_field_of_a_family() {
    for (body, pointer) in [
        (json!({"kind": "part", "tool_length": [50, -1]}), "/tool_length"),
        (json!({"kind": "part", "tool_length": [50, "long"]}), "/tool_length/1"),
        (json!({"kind": "part", "tool_length": [50, null]}), "/tool_length/1"),
        (json!({"kind": "part", "tool_length": []}), "/tool_length"),
        (json!({"kind": "part", "phi1": [0, 1e9]}), "/phi1"),
        (json!({"kind": "part", "phi2": {"from": 0, "to": 10, "step": 0}}), "/phi2"),
        (json!({"kind": "part", "phi2": {"from": 0, "to": 10}}), "/phi2/step"),
        (json!({"kind": "part", "phi2": {"from": 0, "to": 10, "step": 1, "by": 1}}), "/phi2/by"),
        (json!({"kind": "part", "phi2": {"from": 0, "to": "x", "step": 1}}), "/phi2/to"),
        (json!({"kind": "part", "phi2": [0, 1], "tolerance": 0}), "/tolerance"),
        (json!({"kind": "part", "phi2": [0, 1], "machine": "nautilus"}), "/machine"),
        // The platform has no tool, and nothing but a part turns.
        (json!({"tool_length": [50, 60]}), "/tool_length"),
        (json!({"kind": "tool", "phi1": [0, 5]}), "/phi1"),
        (json!({"kind": "tool", "phi2": {"from": 0, "to": 5, "step": 5}}), "/phi2"),
    ] {
        post("/workspace", body).await.assert_bad_field(pointer);
    }
}

#[tokio::test]
async fn a_family_has_at_most_a_thousand_members() {
    let steps = |to: u32| json!({"from": 1, "to": to, "step": 1});
    for (body, pointer) in [
        (json!({"kind": "part", "tool_length": steps(1001)}), "/tool_length"),
        (json!({"kind": "part", "tool_length": vec![1; 1001]}), "/tool_length"),
        (json!({"kind": "part", "phi1": steps(40), "phi2": steps(26)}), ""),
    ] {
        post("/workspace", body).await.assert_bad_field(pointer);
    }
}

#[tokio::test]
async fn a_family_has_neither_mesh_nor_slice() {
    let service = service().await;
    let question = json!({"kind": "tool", "tool_length": [50, 60], "tolerance": 100});
    let request = json_request(axum::http::Method::POST, "/workspace?format=glb", question.clone());
    send_to(service.clone(), request).await.assert_problem(404, "no_mesh");
    let path = table(&service, question).await["links"]["self"].as_str().unwrap().to_owned();
    for (below, code) in [("mesh", "no_mesh"), ("mesh?format=stl", "no_mesh"), ("slice?z=1200", "no_slice")] {
        get_from(&service, &format!("{path}/{below}"), &[]).await.assert_problem(404, code);
    }
}
