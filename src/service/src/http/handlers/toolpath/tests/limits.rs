//! What the service answers at limits: retracts, and changes that heal.

use axum::http::StatusCode;
use serde_json::json;

use super::{JSON, plan, post, service};

#[tokio::test]
async fn a_failing_stretch_states_the_change_that_heals_it() {
    let service = service().await;
    let points = json!([[-20, 0, 800], [20, 0, 800]]);
    let request = json!({"program": {"points": points}, "tool_length": 80});
    let report = plan(&service, &request).await;
    let change = &report["failures"][0]["change"];
    assert_eq!(change["parameter"], "setup.z", "{report}");
    let mut request = request;
    request["setup"] = json!({"z": change["delta"]});
    assert_eq!(plan(&service, &request).await["verdict"], "ok", "{change}");
}

#[tokio::test]
async fn a_helix_of_five_turns_runs_if_the_tool_may_leave_the_part() {
    let service = service().await;
    let point = |i: i32| {
        let angle = f64::from(i) * 6.0;
        let (sine, cosine) = angle.to_radians().sin_cos();
        json!([40.0 * cosine, 40.0 * sine, 300.0 + 0.2 * f64::from(i), 10, angle])
    };
    let points: Vec<_> = (0..=300).map(point).collect();
    let mut request = json!({"program": {"points": points}, "tool_length": 100});
    let report = plan(&service, &request).await;
    assert_eq!((&report["verdict"], &report["retracts"]), (&json!("fails"), &json!(0)));
    request["on_limit"] = json!("retract");
    let report = plan(&service, &request).await;
    assert_eq!(
        (&report["verdict"], &report["retracts"]),
        (&json!("ok"), &json!(2)),
        "{}",
        report["failures"]
    );
    assert_eq!(report["request"]["clearance"], 50.0);
    request["retract_z"] = json!(5000);
    assert_eq!(plan(&service, &request).await["verdict"], "fails");
    request["on_limit"] = json!("fail");
    let (status, problem) = post(&service, "/toolpath", JSON, request.to_string()).await;
    assert_eq!(
        (status, &problem["errors"][0]["pointer"]),
        (StatusCode::UNPROCESSABLE_ENTITY, &json!("/retract_z"))
    );
}
