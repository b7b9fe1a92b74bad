//! `/workspace/error-budget`: points against single budgets, meshes, invalid requests.

use axum::Router;
use axum::http::Method;
use serde_json::{Value, json};

use super::workspace::ask;
use super::{Reply, get_from, json_request, post, send_to, service};

/// POST /workspace/error-budget on a service that keeps its results.
async fn map(service: &Router, question: Value) -> Reply {
    send_to(service.clone(), json_request(Method::POST, "/workspace/error-budget", question)).await
}

fn tolerances() -> Value {
    json!({"L1": 0.02, "L2": 0.02, "L3": 0.02, "o1": 0.005, "tilt_zero": 0.001, "rotary_axis_x": 0.01})
}

fn coarse(kind: &str) -> Value {
    json!({"kind": kind, "tool_length": 50, "phi1": if kind == "part" { 10 } else { 0 }, "cell": 150,
           "tolerance": 20, "parameter_tolerances": tolerances()})
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

#[allow(clippy::cast_precision_loss, reason = "indices of a grid are small")]
fn position(grid: &Value, point: u64) -> [f64; 3] {
    let [_, across, up] = [0, 1, 2].map(|axis: usize| grid["counts"][axis].as_u64().unwrap());
    let steps = [point / up / across, point / up % across, point % up];
    let at = |axis: usize| {
        grid["origin"][axis].as_f64().unwrap() + grid["step"].as_f64().unwrap() * steps[axis] as f64
    };
    [at(0), at(1), at(2)]
}

#[tokio::test(flavor = "multi_thread")]
async fn points_have_the_errors_of_their_budgets() {
    let service = service().await;
    for kind in ["tool", "part"] {
        let summary = map(&service, coarse(kind)).await.json;
        let cells = get_from(&service, summary["links"]["cells"].as_str().unwrap(), &[]).await.json;
        assert_eq!(cells["grid"], summary["grid"]);
        let points: Vec<u64> =
            cells["points"].as_array().unwrap().iter().map(|point| point.as_u64().unwrap()).collect();
        assert_eq!(points.len() as u64, summary["inside"].as_u64().unwrap());
        assert!(points.len() > 20, "{}", points.len());
        let poses: Vec<Vec<f64>> = points
            .iter()
            .map(|point| {
                let orientation: &[f64] = if kind == "part" { &[10.0, 0.0] } else { &[] };
                [&position(&cells["grid"], *point), orientation].concat()
            })
            .collect();
        let body =
            json!({"frame": kind, "tool_length": 50, "parameter_tolerances": tolerances(), "poses": poses});
        let request = json_request(Method::POST, "/error-budget", body);
        let budgets = send_to(service.clone(), request).await.json;
        assert_eq!(budgets["counts"]["ok"].as_u64().unwrap(), points.len() as u64, "{}", budgets["counts"]);
        for (name, figure, of) in
            [("tip_rms", "tip", "rms"), ("tip_worst", "tip", "worst"), ("axis_worst", "axis", "worst")]
        {
            let (range, column) = (&summary["errors"][name], numbers(&cells[name]));
            for (budget, found) in budgets["budgets"].as_array().unwrap().iter().zip(&column) {
                let expected = budget[figure][of].as_f64().unwrap();
                assert!((found - expected).abs() <= 1e-9 * expected, "{name}: {found} {expected}");
                assert!(range["least"].as_f64().unwrap() <= *found, "{name}: {found} {range}");
                assert!(range["largest"].as_f64().unwrap() >= *found, "{name}: {found} {range}");
            }
        }
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn the_surface_has_bands_of_each_error_in_every_format() {
    let service = service().await;
    let summary = map(&service, coarse("part")).await.json;
    let itself = summary["links"]["self"].as_str().unwrap();
    let again = get_from(&service, itself, &[]).await;
    assert_eq!(again.json, summary);
    let mesh = |query: &str| {
        let uri = format!("{itself}/mesh?{query}");
        let service = service.clone();
        async move { get_from(&service, &uri, &[]).await }
    };
    for error in ["tip_rms", "tip_worst", "axis_rms", "axis_worst"] {
        let json = mesh(&format!("format=json&error={error}")).await.json;
        let palette = json["palette"].as_array().unwrap();
        assert_eq!(palette.len(), 10, "{error}");
        let first = palette[0]["name"].as_str().unwrap();
        let unit = if error.starts_with("tip") { " mm" } else { " deg" };
        assert!(first.starts_with(error) && first.ends_with(unit), "{first}");
        let tags = numbers(&json["triangle_tags"]);
        assert_eq!(tags.len() as u64, summary["triangles"].as_u64().unwrap());
        assert!(tags.contains(&0.0) && tags.contains(&9.0), "{error}");
        assert_eq!(json["extras"]["kind"], error);
    }
    let glb = mesh("format=glb").await.bytes;
    assert!(glb.starts_with(b"glTF"));
    assert_eq!(glb, mesh("format=glb&error=tip_worst").await.bytes, "the default");
    assert!(mesh("format=ply").await.bytes.starts_with(b"ply"));
    assert_eq!(mesh("format=stl").await.bytes.len() as u64, 84 + 50 * summary["triangles"].as_u64().unwrap());
    mesh("format=glb&set=reachable").await.assert_bad_field("/query/set");
    get_from(&service, &format!("{itself}/slice?z=300"), &[]).await.assert_problem(404, "no_slice");
    let table = get_from(&service, &format!("{itself}/cells.csv"), &[]).await;
    let lines = String::from_utf8(table.bytes).unwrap().lines().count() as u64;
    assert_eq!(lines, 1 + summary["inside"].as_u64().unwrap());
    assert!(table.headers["content-disposition"].to_str().unwrap().contains("error-map-"));
    let workspace = ask(&service, json!({"tolerance": 20})).await.json;
    let workspace = workspace["links"]["self"].as_str().unwrap();
    get_from(&service, &format!("{workspace}/mesh?error=tip_rms"), &[])
        .await
        .assert_bad_field("/query/error");
}

#[tokio::test(flavor = "multi_thread")]
async fn equal_requests_have_equal_ids() {
    let service = service().await;
    let first = map(&service, coarse("tool")).await.json;
    let mut same = coarse("tool");
    same["parameter_tolerances"]["dt"] = json!(0);
    same["phi1"] = json!(33);
    assert_eq!(map(&service, same).await.json, first, "what has no effect is no part of the request");
    let mut other = coarse("tool");
    other["parameter_tolerances"]["L1"] = json!(0.021);
    assert_ne!(map(&service, other).await.json["id"], first["id"]);
}

#[tokio::test]
async fn a_problem_names_the_field() {
    let with = |field: &str, value: Value| {
        let mut body = coarse("part");
        body[field] = value;
        body
    };
    for (body, pointer) in [
        (json!({}), "/parameter_tolerances"),
        (with("parameter_tolerances", json!({})), "/parameter_tolerances"),
        (with("parameter_tolerances", json!({"o4": 1})), "/parameter_tolerances/o4"),
        (with("cell", json!(0.5)), "/cell"),
        (with("tolerance", json!(0)), "/tolerance"),
        (with("tool_length", json!(-1)), "/tool_length"),
        (with("phi1", json!(1e9)), "/phi1"),
        (with("colour", json!(1)), "/colour"),
        // The grid is known only when the job has begun.
        (with("cell", json!(2)), "/cell"),
    ] {
        post("/workspace/error-budget", body).await.assert_bad_field(pointer);
    }
    let two = json!({"cell": 0, "tolerance": 0, "parameter_tolerances": tolerances()});
    let reply = post("/workspace/error-budget", two).await;
    reply.assert_problem(422, "invalid_request");
    assert_eq!(reply.json["errors"].as_array().unwrap().len(), 2, "{}", reply.json);
}
