//! `/workspace`: figures, ids, negotiation, invalid requests.

use axum::Router;
use axum::http::header::{ACCEPT, CACHE_CONTROL, CONTENT_TYPE};
use axum::http::{HeaderValue, Method, StatusCode};
use serde_json::{Value, json};

use super::{Reply, get, get_from, json_request, post, send_to, service};

/// POST /workspace on a service that keeps its results.
pub(super) async fn ask(service: &Router, question: Value) -> Reply {
    let mut request = json_request(Method::POST, "/workspace", question);
    // The machine may have other work to do.
    request.headers_mut().insert("prefer", HeaderValue::from_static("wait=600"));
    send_to(service.clone(), request).await
}

fn assert_close(found: &Value, wanted: f64, relative: f64) {
    let found = found.as_f64().unwrap();
    assert!((found - wanted).abs() <= relative * wanted.abs(), "{found} is not {wanted}");
}

/// Published figures: a sweep of columns, good to about 1e-5.
#[tokio::test]
async fn volume_and_bounds_agree_with_an_independent_sweep() {
    let service = service().await;
    for (question, volume) in [
        (json!({}), 2.33692e8),
        (json!({"kind": "tool", "tool_length": 50}), 2.44325e8),
        (json!({"kind": "tool", "tool_length": 150}), 2.65591e8),
        (json!({"kind": "tool", "tool_length": 300}), 2.97490e8),
        (json!({"kind": "part", "tool_length": 50}), 3.00444e8),
        (json!({"kind": "part", "phi1": -30, "phi2": 200}), 3.00444e8),
        (json!({"kind": "part", "phi1": 60}), 2.99485e8),
    ] {
        let answer = ask(&service, question).await.json;
        assert_close(&answer["volume"], volume, 1e-5);
        // At phi1 = 60° the tilt's range cuts the domain as well.
        if answer["request"]["phi1"] != 60.0 {
            assert_close(&answer["area"], 657_677.0, 2e-5);
        }
        let (volume, error) = (answer["volume"].as_f64().unwrap(), answer["volume_error"].as_f64().unwrap());
        assert!(error < 1e-6 * volume, "{error}");
        assert_eq!(answer["folded"], false);
        assert!(answer["triangles"].as_u64().unwrap() < 5_000);
    }
}

#[tokio::test]
async fn the_bounds_are_within_the_tolerance() {
    let bounds = &ask(&service().await, json!({})).await.json["bounds"];
    let wanted = [("min", [-407.0, -540.5, 870.6]), ("max", [392.0, 540.5, 1627.0])];
    for (end, numbers) in wanted {
        for (axis, wanted) in numbers.into_iter().enumerate() {
            let found = bounds[end][axis].as_f64().unwrap();
            assert!((found - wanted).abs() < 1.5, "{end} {axis}: {found}");
        }
    }
}

#[tokio::test]
async fn equal_requests_have_equal_ids() {
    let service = service().await;
    let id = async |question| ask(&service, question).await.json["id"].as_str().unwrap().to_owned();
    let part = id(json!({"kind": "part", "tool_length": 50})).await;
    assert_eq!(part.len(), 64);
    assert_eq!(part, id(json!({"kind": "part", "tool_length": 50.0, "phi1": -0.0, "tolerance": 1})).await);
    assert_ne!(part, id(json!({"kind": "part", "tool_length": 50, "tolerance": 2})).await);
    assert_ne!(part, id(json!({"kind": "tool", "tool_length": 50})).await);
    assert_ne!(part, id(json!({"kind": "part", "tool_length": 50, "phi2": 10})).await);
    let by_query = get_from(&service, "/workspace?kind=part&tool_length=50", &[]).await;
    assert_eq!(by_query.json["id"], part);
    assert!(by_query.headers[CACHE_CONTROL].to_str().unwrap().contains("max-age"));
    // Fields without effect on the platform do not change the id.
    assert_eq!(id(json!({})).await, id(json!({"kind": "platform", "tool_length": 70, "phi1": 3})).await);
    let platform = ask(&service, json!({"phi1": 3})).await.json;
    assert_eq!(platform["request"], json!({"kind": "platform", "tolerance": 1.0}));
}

#[tokio::test]
async fn results_of_different_machines_have_different_ids() {
    let mut machine = get("/machines/verne").await.json["definition"].clone();
    let service = service().await;
    let original = ask(&service, json!({"machine": machine, "tolerance": 20})).await.json;
    assert_eq!(original, ask(&service, json!({"tolerance": 20})).await.json);
    machine["name"] = "mine".into();
    let renamed = ask(&service, json!({"machine": machine, "tolerance": 20})).await.json;
    assert_eq!(renamed["machine"]["hash"], original["machine"]["hash"]);
    assert_eq!(renamed["machine"]["name"], "mine");
    assert_ne!(renamed["id"], original["id"], "the name is part of the answer");
    machine["geometry"]["rod_radius"] = 60.into();
    let thick = ask(&service, json!({"machine": machine})).await.json;
    // 900² columns at random places in their cells: regular ones would count an edge that runs along them wholly or
    // not at all.
    assert_close(&thick["volume"], 2.104_444e8, 1e-5);
    assert_close(&thick["area"], 558_150.0, 5e-5);
}

#[tokio::test]
async fn an_empty_workspace_is_answered_with_200() {
    let mut machine = get("/machines/verne").await.json["definition"].clone();
    machine["geometry"]["rod_radius"] = 1000.into();
    let service = service().await;
    let answer = ask(&service, json!({"machine": machine})).await.json;
    assert_eq!(answer["volume"], 0.0);
    assert_eq!((&answer["bounds"], &answer["triangles"]), (&Value::Null, &json!(0)));
    for format in ["glb", "stl", "ply", "json"] {
        let uri = format!("{}?format={format}", answer["links"]["mesh"].as_str().unwrap());
        assert_eq!(get_from(&service, &uri, &[]).await.status, StatusCode::OK, "{format}");
    }
    let slice = format!("{}/slice?z=1200&alpha=true", answer["links"]["self"].as_str().unwrap());
    assert_eq!(get_from(&service, &slice, &[]).await.json["polygons"], json!([]));
}

#[tokio::test]
async fn a_folded_workspace_has_no_volume_and_a_reason() {
    let service = service().await;
    // The table's axis above the platform: the Jacobian determinant changes its sign within the workspace.
    let mut above = get("/machines/verne").await.json["definition"].clone();
    above["table"]["da"] = 0.into();
    // Two separate parts of the platform's domain map onto one set, with one sign throughout.
    for machine in [above, covered_twice()] {
        let question = json!({"machine": machine, "kind": "part", "tolerance": 20});
        let answer = ask(&service, question).await.json;
        assert_eq!(answer["folded"], true, "{answer}");
        assert!(answer["volume"].is_null() && answer["volume_error"].is_null(), "{answer}");
        assert!(answer["explanation"].as_str().unwrap().contains("two platform positions"), "{answer}");
    }
    let plain = ask(&service, json!({"kind": "part", "tolerance": 20})).await.json;
    assert_eq!(plain["folded"], false);
    assert!(plain["volume"].is_number() && plain.get("explanation").is_none(), "{plain}");
}

/// A machine whose table is above the platform, and whose cones exclude the middle of the platform's domain.
pub(super) fn covered_twice() -> Value {
    json!({
        "name": "covered twice",
        "geometry": {
            "D1": 0, "d1": 400, "D2": 0, "d2": -400, "R1": 220, "r1": 60, "R2": 40, "r4": 40, "L1": 840, "L2": 566,
            "L3": 566, "parallelogram_half_width": 16, "rod_radius": 0,
        },
        "table": {"da": -608, "dt": 160},
        "limits": {
            "stroke": [[-1600, 1600], [0, 320], [0, 320]], "slider_cone": 61.6, "platform_cone": 180,
            "serial_margin": 0.42, "parallel_margin": 0, "tilt": [-90, 90], "rotary": [-360, 360],
            "slider_axes": [[-1, 0, 0], [-1, 0, 0], [0.7, 0, 0.7], [0.7, 0, 0.7]],
        },
    })
}

#[tokio::test]
async fn every_working_solution_is_considered() {
    let machine = covered_twice();
    let point = [-16.3, 0.13, -789.0];
    let [x, y, z] = point;
    let ask = async |wanted: &str| {
        let pose = json!({"x": x, "y": y, "z": z, "phi1": 0, "phi2": 0});
        let reply = post("/ik", json!({"machine": machine, "pose": pose, "solutions": wanted})).await;
        reply.solutions().clone()
    };
    let all = ask("all").await;
    let of = |flag: &str| all.iter().filter(|solution| solution[flag] == true).cloned().collect::<Vec<_>>();
    let (working, feasible) = (of("working"), of("feasible"));
    assert!(working.len() == 3 && feasible.len() == 2, "{working:?}");
    assert_eq!(ask("working").await, working);
    assert_eq!(ask("feasible").await, feasible);
    let contains =
        post("/workspace/contains", json!({"machine": machine, "kind": "part", "points": [point]})).await;
    assert_eq!(contains.json["inside"], json!([true]), "{}", contains.json);
    let batch = post("/ik/batch", json!({"machine": machine, "poses": [[x, y, z, 0, 0]]})).await.json;
    assert_eq!(batch["status"], json!(["ok"]));
    let joints = &feasible[0]["joints"];
    let first =
        json!([joints["rho"][0], joints["rho"][1], joints["rho"][2], joints["theta1"], joints["theta2"]]);
    assert_eq!(batch["joints"], json!([first]));
}

#[tokio::test]
async fn accept_and_format_select_the_representation() {
    let service = service().await;
    for (accept, format, media) in [
        (None, None, "application/json"),
        (Some("*/*"), None, "application/json"),
        (Some("model/*"), None, "model/gltf-binary"),
        (Some("model/gltf-binary;q=0.4, model/ply;q=0.5"), None, "model/ply"),
        (Some("text/html, */*;q=0.1"), None, "application/json"),
        (Some("application/json"), Some("stl"), "model/stl"),
        (Some("text/html"), Some("glb"), "model/gltf-binary"),
    ] {
        let uri = format.map_or("/workspace?tolerance=20".to_owned(), |format| {
            format!("/workspace?tolerance=20&format={format}")
        });
        let headers: Vec<_> = accept.into_iter().map(|accept| (ACCEPT, accept)).collect();
        let reply = get_from(&service, &uri, &headers).await;
        assert_eq!(reply.headers[CONTENT_TYPE], media, "{accept:?} {format:?}");
    }
    // The format json is the mesh.
    let mesh = get_from(&service, "/workspace?tolerance=20&format=json", &[]).await.json;
    assert!(mesh["positions"].is_array() && mesh["indices"].is_array());
    let refused = get_from(&service, "/workspace?tolerance=20", &[(ACCEPT, "text/html")]).await;
    refused.assert_problem(406, "not_acceptable");
    assert!(refused.json["detail"].as_str().unwrap().contains("model/gltf-binary"));
}

#[tokio::test]
async fn a_problem_names_the_field() {
    for (body, pointer) in [
        (json!({"kind": "nautilus"}), "/kind"),
        (json!({"tolerance": 0}), "/tolerance"),
        (json!({"tolerance": 1e-3}), "/tolerance"),
        (json!({"tolerance": 1e5}), "/tolerance"),
        (json!({"tool_length": -1}), "/tool_length"),
        (json!({"kind": "part", "phi1": 1e9}), "/phi1"),
        (json!({"machine": "nautilus"}), "/machine"),
        (json!({"colour": "blue"}), "/colour"),
    ] {
        post("/workspace", body).await.assert_bad_field(pointer);
    }
    for (query, pointer) in [
        ("tolerance=0", "/query/tolerance"),
        ("tolerance=NaN", "/query/tolerance"),
        ("phi2=inf", "/query/phi2"),
        ("format=obj", "/query/format"),
        ("tolerance=1&tolerance=2", "/query/tolerance"),
    ] {
        get(&format!("/workspace?{query}")).await.assert_bad_field(pointer);
    }
    post("/workspace?format=step", "{}").await.assert_bad_field("/query/format");
}

/// A workspace of 2 mm² has a volume, but no triangle at a coarse tolerance; the answer explains it.
#[tokio::test]
async fn a_workspace_thinner_than_the_tolerance_has_an_explanation() {
    let mut machine = get("/machines/verne").await.json["definition"].clone();
    machine["limits"]["serial_margin"] = 0.835_024_823_061_727_1.into();
    let service = service().await;
    let coarse = ask(&service, json!({"machine": machine, "tolerance": 20})).await.json;
    assert_eq!((&coarse["bounds"], &coarse["triangles"]), (&Value::Null, &json!(0)));
    assert!(coarse["explanation"].as_str().unwrap().contains("thinner than the tolerance"));
    let fine = ask(&service, json!({"machine": machine, "tolerance": 0.05})).await.json;
    assert!(fine["triangles"].as_u64().unwrap() > 0 && fine["explanation"].is_null());
    assert_eq!((&fine["volume"], &fine["area"]), (&coarse["volume"], &coarse["area"]));
    assert!(fine["area"].as_f64().unwrap() > 1.0);
}

/// theta1 jumps by a turn beyond its range, and not through it: nothing is there.
#[tokio::test]
async fn a_tool_beyond_the_tilting_range_has_an_empty_workspace() {
    let answer = get("/workspace?kind=part&tool_length=50&phi1=170&tolerance=20").await.json;
    for field in ["volume", "volume_error", "area", "area_error"] {
        assert_eq!(answer[field], 0.0, "{field}");
    }
    assert_eq!((&answer["triangles"], &answer["explanation"]), (&json!(0), &Value::Null));
}
