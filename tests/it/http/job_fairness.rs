//! Large jobs of one client do not delay others.

use axum::http::StatusCode;
use serde_json::{Value, json};

use super::jobs::{cancel, job, one_core, small, start, until};
use super::opened;
use super::workspace::ask;

/// A small request for a mesh of two million triangles: strokes of 4 m, at the finest tolerance.
fn walls(tool_length: u32) -> Value {
    let text = include_str!("../../reference/machine-verne.json");
    let mut machine: Value = serde_json::from_str(text).unwrap();
    machine["limits"]["stroke"] = json!([[0, 4_000], [0, 4_000], [0, 4_000]]);
    json!({"machine": machine, "kind": "part", "tool_length": tool_length, "tolerance": 0.0101})
}

#[tokio::test]
async fn two_small_requests_do_not_stop_all_jobs() {
    let service = opened(&one_core()).await;
    let first = start(&service, &walls(50)).await;
    until(&service, &first, |job| job["state"] == "running").await;
    let second = start(&service, &walls(60)).await;
    assert_eq!(ask(&service, small(50)).await.status, StatusCode::OK);
    // Its estimate says that it is large: it does not take the place of small ones.
    assert_eq!(job(&service, &second).await["state"], "queued");
    assert_eq!(job(&service, &first).await["state"], "running");
    for id in [second, first] {
        cancel(&service, &id).await;
        until(&service, &id, |job| job["state"] == "cancelled").await;
    }
}
