//! Where programs begin, what they hold, and where the tool stands.

use axum::http::StatusCode;
use serde_json::{Value, json};
use verne_solver::toolpath::RowKind;

use super::{FORM, JSON, LINE, plan, post, rows_of, service};

#[tokio::test]
async fn a_start_is_the_first_row_and_its_sliders_count() {
    let service = service().await;
    let of_machine = super::get(&service, "/machines/verne").await.1;
    let mut machine = of_machine["definition"].clone();
    let axis = json!({"velocity": 20});
    machine["drives"] = json!({"slider": {"velocity": 100}, "tilt": axis, "rotary": axis});
    let from = |rho: [f64; 3]| {
        json!({"program": {"points": [[0, 0, 300], {"x": 20, "y": 0, "z": 300, "feed": 600}]}, "tool_length": 100,
               "machine": machine, "start": {"rho": rho, "theta1": 0, "theta2": 30}})
    };
    let mut times = Vec::new();
    for rho in [[500.0; 3], [300.0; 3]] {
        let report = plan(&service, &from(rho)).await;
        assert_eq!(
            (&report["verdict"], &report["time"]["unknown_rows"]),
            (&json!("ok"), &json!(0)),
            "{report}"
        );
        assert_eq!(report["request"]["start"], json!({"rho": rho, "theta1": 0.0, "theta2": 30.0}));
        let rows = rows_of(&service, &report).await;
        assert_eq!(
            (rows[0].line, rows[0].kind, rows[0].rho, rows[0].duration),
            (1, RowKind::Rapid, rho, None)
        );
        assert!(rows[1..].iter().all(|row| row.duration.is_some()));
        times.push(report["time"]["seconds"].as_f64().unwrap());
    }
    assert!((times[0] - times[1]).abs() > 0.3, "the sliders need time: {times:?}");
    let (_, query) = post(
        &service,
        "/toolpath?format=apt&tool_length=100&start={%22rho%22:[500,500,500],%22theta1%22:0,%22theta2%22:0}",
        FORM,
        LINE,
    )
    .await;
    assert_eq!(query["verdict"], "ok", "{query}");
}

#[tokio::test]
async fn a_start_outside_its_ranges_is_a_field_error() {
    let service = service().await;
    let start =
        |rho: Value, theta1: f64, theta2: f64| json!({"rho": rho, "theta1": theta1, "theta2": theta2});
    for (start, pointer) in [
        (start(json!([500, 500, 500]), 0.0, 361.0), "/start/theta2"),
        (start(json!([500, 500, 500]), -200.0, 0.0), "/start/theta1"),
        (start(json!([500, 9000, 500]), 0.0, 0.0), "/start/rho/1"),
        (json!({"theta1": 0, "theta2": 0}), "/start/rho"),
    ] {
        let request = json!({"program": {"points": [[0, 0, 300]]}, "tool_length": 100, "start": start});
        let (status, problem) = post(&service, "/toolpath", JSON, request.to_string()).await;
        assert_eq!(status, StatusCode::UNPROCESSABLE_ENTITY, "{start} {problem}");
        assert_eq!(problem["errors"][0]["pointer"], pointer, "{start} {problem}");
    }
    let mut machine = super::get(&service, "/machines/verne").await.1["definition"].clone();
    machine["limits"]["stroke"][0] = json!([0, 2000]);
    let request = json!({"program": {"points": [[0, 0, 300]]}, "tool_length": 100, "machine": machine,
        "start": start(json!([1500, 0, 0]), 0.0, 0.0)});
    let (_, problem) = post(&service, "/toolpath", JSON, request.to_string()).await;
    assert_eq!(problem["errors"][0]["pointer"], "/start/rho", "no working posture: {problem}");
}

#[tokio::test]
async fn a_turn_of_c_at_the_pole_counts_if_it_is_held() {
    let service = service().await;
    let points = json!([[60, 0, 300, 0, 0], [60, 0, 300, 0, 90]]);
    let mut request = json!({"program": {"points": points}, "tool_length": 100});
    let free = plan(&service, &request).await;
    assert_eq!((&free["turning"]["theta2"], &free["request"]["hold_rotary"]), (&json!(0.0), &Value::Null));
    request["hold_rotary"] = json!(true);
    let held = plan(&service, &request).await;
    assert!((held["turning"]["theta2"].as_f64().unwrap() - 90.0).abs() < 1e-9, "{held}");
    assert_eq!((&held["verdict"], &held["request"]["hold_rotary"]), (&json!("ok"), &json!(true)));
    assert_ne!(held["id"], free["id"]);
    let gcode = "G21 G90\nG43.4 H1 G0 X60 Y0 Z300 A0 C0\nG1 C90 F500\n";
    let query = "/toolpath?format=gcode&tool_length=100&hold_rotary=true";
    let (_, of_file) = post(&service, query, FORM, gcode).await;
    assert!((of_file["turning"]["theta2"].as_f64().unwrap() - 90.0).abs() < 1e-9, "{of_file}");
    for field in [json!({"setup": {"a": 1}}), json!({"orientation": "vector"})] {
        let mut request = request.clone();
        request.as_object_mut().unwrap().extend(field.as_object().unwrap().clone());
        let (status, problem) = post(&service, "/toolpath", JSON, request.to_string()).await;
        assert_eq!(
            (status, &problem["errors"][0]["pointer"]),
            (StatusCode::UNPROCESSABLE_ENTITY, &json!("/hold_rotary")),
            "{problem}"
        );
    }
}

#[tokio::test]
async fn a_turn_while_the_tool_stands_is_a_dwell_mark() {
    let service = service().await;
    let point =
        |phi1: f64, phi2: f64| json!({"x": 60, "y": 0, "z": 300, "phi1": phi1, "phi2": phi2, "feed": 500});
    let points = [point(10.0, 0.0), point(0.0, 0.0), point(10.0, 60.0)];
    let mut request = json!({"program": {"points": points}, "tool_length": 100, "pole": 0,
        "orientation": "vector"});
    let report = plan(&service, &request).await;
    assert_eq!((&report["verdict"], &report["dwell_mark_count"]), (&json!("ok"), &json!(1)), "{report}");
    let mark = &report["dwell_marks"][0];
    let number = |name: &str| mark[name].as_f64().unwrap();
    assert_eq!([number("x"), number("y"), number("z")], [60.0, 0.0, 300.0], "{mark}");
    assert!((number("angle") - 60.0).abs() < 1e-6, "{mark}");
    let rows = rows_of(&service, &report).await;
    let turns = rows.iter().filter(|row| row.kind == RowKind::Turn);
    let duration: Option<f64> = turns.map(|row| row.duration).sum();
    assert_eq!(mark["duration"], json!(duration), "{mark}");
    request["pole"] = json!(0.025);
    request["program"]["points"] = json!([[60, 0, 300, 10, 0], [50, 0, 300, 10, 30]]);
    let report = plan(&service, &request).await;
    assert_eq!((&report["dwell_marks"], &report["dwell_mark_count"]), (&json!([]), &json!(0)));
}

/// The tool is 30 mm longer from the second line on: its end moves down, and the way from there is checked.
#[tokio::test]
async fn a_feed_move_after_a_change_of_length_has_rows() {
    let service = service().await;
    let gcode = "G21 G90\nG43.4 H1 G0 X0 Y0 Z330\nG43.4 H2\nG1 X100 Z300 F500\nM2\n";
    let query = "/toolpath?format=gcode&tool_length={%221%22:100,%222%22:130}";
    let (_, report) = post(&service, query, FORM, gcode).await;
    assert_eq!((&report["verdict"], &report["warnings"]), (&json!("ok"), &json!([])), "{report}");
    assert_eq!(report["length"], json!({"feed": 100.0, "rapid": 0.0}), "from (0, 0, 300) to (100, 0, 300)");
    let rows = rows_of(&service, &report).await;
    assert!(rows.iter().filter(|row| row.line == 4).count() > 5, "{} rows", rows.len());
    let level = rows.iter().skip(1).all(|row| (row.position.tip[2] - 300.0).abs() < 1e-9);
    assert!(level && rows[1..].iter().all(|row| row.duration.is_some()));
}

#[tokio::test]
async fn a_table_without_a_limit_turns_through_all_turns_of_a_program() {
    let service = service().await;
    let mut machine = super::get(&service, "/machines/verne").await.1["definition"].clone();
    machine["limits"]["rotary"] = Value::Null;
    let points = json!([[60, 0, 300, 20, 0], [60, 0, 300, 20, 3600]]);
    let mut request = json!({"program": {"points": points}, "tool_length": 100, "machine": machine,
        "start": {"rho": [500, 500, 500], "theta1": 0, "theta2": 5000}});
    let report = plan(&service, &request).await;
    assert_eq!(report["verdict"], "ok", "{}", report["failures"]);
    let turned = report["turning"]["theta2"].as_f64().unwrap();
    assert!((3600.0..3600.0 + 90.0 + 1e-6).contains(&turned), "{turned}");
    let constraints = report["margins"].as_array().unwrap().iter().map(|margin| &margin["constraint"]);
    assert!(constraints.into_iter().all(|constraint| constraint != "rotary"), "{report}");
    request["machine"]["limits"].as_object_mut().unwrap().remove("rotary");
    let (status, problem) = post(&service, "/toolpath", JSON, request.to_string()).await;
    assert_eq!(status, StatusCode::UNPROCESSABLE_ENTITY, "missing is not null: {problem}");
}
