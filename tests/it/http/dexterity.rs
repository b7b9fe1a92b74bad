//! `/workspace/dexterity`: figures, points against membership, meshes, invalid requests.

use std::num::NonZeroUsize;

use axum::Router;
use axum::http::{Method, header};
use serde_json::{Value, json};

use super::workspace::ask;
use super::{Reply, config, get_from, json_request, opened, post, send_to, service};

/// POST /workspace/dexterity on a service that keeps its results.
async fn map(service: &Router, question: Value) -> Reply {
    send_to(service.clone(), json_request(Method::POST, "/workspace/dexterity", question)).await
}

fn coarse() -> Value {
    json!({"tool_length": 50, "phi1": {"from": -20, "to": 20}, "phi2": 30, "cell": 150})
}

/// A point of the grid in the part frame.
#[allow(clippy::cast_precision_loss, reason = "indices of a grid are small")]
fn point(grid: &Value, [i, j, k]: [u64; 3]) -> [f64; 3] {
    let step = grid["step"].as_f64().unwrap();
    let at = |axis: usize, n: u64| grid["origin"][axis].as_f64().unwrap() + step * n as f64;
    let (x, y) = (at(0, i), at(1, j));
    let (s, c) = grid["turn"].as_f64().unwrap().to_radians().sin_cos();
    [x * c - y * s, x * s + y * c, at(2, k)]
}

#[tokio::test(flavor = "multi_thread")]
async fn dexterity_agrees_with_membership() {
    let service = service().await;
    let summary = map(&service, coarse()).await.json;
    let cells = get_from(&service, summary["links"]["cells"].as_str().unwrap(), &[]).await.json;
    assert_eq!(cells["grid"], summary["grid"]);
    let counts: Vec<u64> =
        cells["grid"]["counts"].as_array().unwrap().iter().map(|n| n.as_u64().unwrap()).collect();
    let offsets = cells["offsets"].as_array().unwrap();
    assert_eq!(offsets.len() as u64, counts.iter().product::<u64>() + 1);
    let intervals: Vec<f64> =
        cells["intervals"].as_array().unwrap().iter().map(|n| n.as_f64().unwrap()).collect();
    let points: Vec<[f64; 3]> = (0..counts[0])
        .flat_map(|i| (0..counts[1]).map(move |j| [i, j]))
        .flat_map(|[i, j]| (0..counts[2]).map(move |k| [i, j, k]))
        .map(|place| point(&cells["grid"], place))
        .collect();
    let mut met = [0; 2];
    for phi1 in [-20.0, -11.3, 0.0, 7.7, 20.0] {
        let body = json!({"kind": "part", "tool_length": 50, "phi1": phi1, "phi2": 30, "points": points});
        let contained =
            send_to(service.clone(), json_request(Method::POST, "/workspace/contains", body)).await.json;
        for (n, inside) in contained["inside"].as_array().unwrap().iter().enumerate() {
            let [from, to] = [n, n + 1].map(|n| 2 * usize::try_from(offsets[n].as_u64().unwrap()).unwrap());
            let within = intervals[from..to].chunks(2).any(|ends| (ends[0]..=ends[1]).contains(&phi1));
            assert_eq!(inside.as_bool().unwrap(), within, "{:?} at {phi1}", points[n]);
            met[usize::from(within)] += 1;
        }
    }
    assert!(met[0] > 50 && met[1] > 50, "{met:?}");
}

#[tokio::test(flavor = "multi_thread")]
async fn a_map_of_one_inclination_is_the_part_workspace() {
    let service = service().await;
    let one = json!({"tool_length": 50, "phi1": {"from": 0, "to": 0}, "cell": 200});
    let figures = map(&service, one).await.json;
    let part = ask(&service, json!({"kind": "part", "tool_length": 50})).await.json;
    for set in ["reachable", "dexterous"] {
        let (found, error) = (&figures[set]["volume"], figures[set]["volume_error"].as_f64().unwrap());
        let difference = found.as_f64().unwrap() - part["volume"].as_f64().unwrap();
        assert!(difference.abs() <= error, "{set}: {difference} is beyond {error}");
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn each_set_has_a_mesh_with_the_same_bytes_for_any_number_of_threads() {
    let mut bytes = Vec::new();
    for threads in [1, 3] {
        let threads = NonZeroUsize::new(threads);
        let service = opened(&verne_service::ServeConfig { job_threads: threads, ..config(None) }).await;
        let summary = map(&service, coarse()).await;
        let links = &summary.json["links"];
        let mut all = vec![summary.bytes];
        for link in ["reachable", "dexterous", "cells"] {
            let reply = get_from(&service, links[link].as_str().unwrap(), &[]).await;
            assert_eq!(reply.status, 200, "{link}: {}", reply.json);
            assert!(reply.headers[header::CACHE_CONTROL].to_str().unwrap().contains("immutable"));
            all.push(reply.bytes);
        }
        assert_ne!(all[1], all[2]);
        let itself = links["self"].as_str().unwrap();
        assert_eq!(get_from(&service, itself, &[]).await.bytes, all[0]);
        get_from(&service, &format!("{itself}/slice?z=300"), &[]).await.assert_problem(404, "no_slice");
        bytes.push(all);
    }
    assert!(bytes[0] == bytes[1]);
}

#[tokio::test]
async fn a_workspace_has_one_mesh_and_no_points() {
    let service = service().await;
    let summary = ask(&service, json!({"tolerance": 20})).await.json;
    let itself = summary["links"]["self"].as_str().unwrap();
    get_from(&service, &format!("{itself}/cells"), &[]).await.assert_problem(404, "no_cells");
    get_from(&service, &format!("{itself}/mesh?set=dexterous"), &[]).await.assert_bad_field("/query/set");
}

#[tokio::test]
async fn a_problem_names_the_field() {
    for (body, pointer) in [
        (json!({}), "/phi1"),
        (json!({"phi1": {"from": 0}}), "/phi1/to"),
        (json!({"phi1": {"from": 10, "to": -10}}), "/phi1"),
        (json!({"phi1": {"from": -200, "to": 200}}), "/phi1"),
        (json!({"phi1": {"from": 0, "to": 1e9}}), "/phi1/to"),
        (json!({"phi1": {"from": 0, "to": 1}, "cell": 0.1}), "/cell"),
        (json!({"phi1": {"from": 0, "to": 1}, "tool_length": -1}), "/tool_length"),
        (json!({"phi1": {"from": 0, "to": 1}, "colour": 1}), "/colour"),
        // The grid is known only when the job has begun.
        (json!({"phi1": {"from": 0, "to": 1}, "cell": 2}), "/cell"),
    ] {
        post("/workspace/dexterity", body).await.assert_bad_field(pointer);
    }
}
