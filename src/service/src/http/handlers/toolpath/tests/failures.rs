//! Failures are reproduced by single questions.

use serde_json::{Value, json};

use super::{JSON, plan, post, service};

/// Asserts that a margin of an answer is that of a failure.
fn assert_reproduced(found: &Value, failure: &Value) {
    for name in ["constraint", "element", "unit"] {
        assert_eq!(found[name], failure[name], "{found} {failure}");
    }
    let [found, stated] = [&found["value"], &failure["margin"]].map(|value| value.as_f64().unwrap());
    assert!((found - stated).abs() <= 1e-6 * stated.abs().max(1.0), "{found} {failure}");
}

#[tokio::test]
async fn ik_reproduces_a_failure() {
    let service = service().await;
    let programs = [
        // Past a stroke, out of reach, past a range of the tilting axis.
        json!([[0, 0, 300], [0, 0, 2000]]),
        json!([[0, 0, 300], [900, 0, 300]]),
        json!([[0, 0, 300, 0, 0, 1], [0, 0, 300, 0, -0.9, -0.4]]),
    ];
    for points in programs {
        let request = json!({"program": {"points": points}, "tool_length": 80, "table_clearance": 0});
        let report = plan(&service, &request).await;
        assert_eq!(report["verdict"], "fails", "{report}");
        for failure in report["failures"].as_array().unwrap() {
            let at = &failure["at"];
            let pose =
                json!({"x": at["x"], "y": at["y"], "z": at["z"], "phi1": at["phi1"], "phi2": at["phi2"]});
            let request = json!({"pose": pose, "tool_length": at["tool_length"], "table_clearance": 0});
            let (_, answer) = post(&service, "/ik", JSON, request.to_string()).await;
            let worst = answer.pointer("/solutions/0/margins/worst").unwrap_or(&answer["constraint"]);
            assert_reproduced(worst, failure);
        }
    }
}

/// /ik takes another winding of theta2; /fk takes the joints as they are.
#[tokio::test]
async fn fk_reproduces_failures_on_every_winding() {
    let service = service().await;
    let turning = json!([[100, 0, 400, 20, 0], [100, 0, 400, 20, 900]]);
    let lifting = json!([[0, 0, 300], [0, 0, 2000]]);
    for (points, constraint) in [(turning, "rotary"), (lifting, "stroke")] {
        let report = plan(&service, &json!({"program": {"points": points}, "tool_length": 80})).await;
        let failure = &report["failures"][0];
        assert_eq!(failure["constraint"], constraint, "{report}");
        let at = &failure["at"];
        let request = json!({"joints": at["joints"], "tool_length": at["tool_length"]});
        let (_, answer) = post(&service, "/fk", JSON, request.to_string()).await;
        assert_reproduced(&answer["solutions"][0]["margins"]["worst"], failure);
        let tool = &answer["solutions"][0]["part"];
        for name in ["x", "y", "z", "phi1", "phi2"] {
            let [found, stated] = [&tool[name], &at[name]].map(|value| value.as_f64().unwrap());
            assert!((found - stated).abs() < 1e-6, "{name}: {tool} {at}");
        }
    }
}
