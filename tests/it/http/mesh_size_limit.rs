//! Meshes of more triangles than the service allows.

use axum::http::StatusCode;
use serde_json::{Value, json};

use super::workspace::ask;
use super::{get_from, opened, service, settings};

#[tokio::test]
async fn a_result_that_would_be_too_large_is_refused_before_it_is_computed() {
    let service = opened(&settings("--memory-only --max-triangles 3000")).await;
    let asked = [
        json!({"tolerance": 0.1}),
        json!({"kind": "part", "tolerance": 0.1}),
        json!({"kind": "tool", "tool_length": [50, 100], "tolerance": 0.1}),
    ];
    for question in asked {
        let refused = ask(&service, question).await;
        refused.assert_bad_field("/tolerance");
        let detail = refused.json["errors"][0]["detail"].as_str().unwrap();
        assert!(
            detail.starts_with("would make about 3") || detail.starts_with("would make about 4"),
            "{detail}"
        );
        assert!(detail.ends_with("000 triangles; the limit is 3000"), "{detail}");
    }
    get_from(&service, "/workspace?tolerance=0.1", &[]).await.assert_bad_field("/query/tolerance");
    assert_eq!(get_from(&service, "/jobs", &[]).await.json["jobs"], json!([]));
    assert_eq!(ask(&service, json!({"tolerance": 10})).await.status, StatusCode::OK);
}

/// Long strokes bend the part's workspace about the table: a tolerance that is fine for the machine is not for that.
#[tokio::test]
async fn millions_of_triangles_are_refused_by_default() {
    let text = include_str!("../../reference/machine-verne.json");
    let mut machine: Value = serde_json::from_str(text).unwrap();
    machine["limits"]["stroke"] = json!([[0, 12_000], [0, 12_000], [0, 12_000]]);
    let refused =
        ask(&service().await, json!({"machine": machine, "kind": "part", "tolerance": 0.0101})).await;
    refused.assert_bad_field("/tolerance");
    let detail = refused.json["errors"][0]["detail"].as_str().unwrap();
    let millions: f64 = detail.split(' ').nth(3).unwrap().parse().unwrap();
    // The mesh has 6.2 million.
    assert!((5.0..8.0).contains(&millions), "{detail}");
    assert!(detail.ends_with(" million triangles; the limit is 5 million"), "{detail}");
}
