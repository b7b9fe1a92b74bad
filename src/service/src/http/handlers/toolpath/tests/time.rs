//! What users rely on in the times of tool paths.

use serde_json::{Value, json};

use super::{FORM, LINE, get, plan, post, rows_of, service};

/// The line is 300 mm long, and the feed is 1000 mm/min.
#[tokio::test]
async fn feed_and_drives_determine_the_time() {
    let service = service().await;
    let (_, by_feed) = post(&service, "/toolpath?format=apt&tool_length=100", FORM, LINE).await;
    let time = &by_feed["time"];
    assert!((time["seconds"].as_f64().unwrap() - 18.0).abs() < 1e-9, "{time}");
    assert_eq!((&time["unknown_rows"], &time["governed"]["feed"]), (&json!(0), &json!(1.0)));
    let mut machine = get(&service, "/machines/verne").await.1["definition"].clone();
    for (velocity, governor) in [(500.0, "feed"), (1.0, "rho")] {
        let axis = json!({"velocity": 60});
        let slider = json!({"velocity": velocity, "acceleration": 100});
        machine["drives"] = json!({"slider": slider, "tilt": axis, "rotary": axis});
        let request = json!({"program": by_feed["program"], "tool_length": 100, "machine": machine});
        let report = plan(&service, &request).await;
        assert_eq!(report["machine"]["hash"], by_feed["machine"]["hash"]);
        assert_ne!(report["id"], by_feed["id"]);
        assert_eq!(report["request"]["cycle"], 0.004);
        let seconds = report["time"]["seconds"].as_f64().unwrap();
        assert!(seconds > 18.0, "{seconds}");
        let durations: f64 = rows_of(&service, &report).await.iter().filter_map(|row| row.duration).sum();
        assert!((durations / seconds - 1.0).abs() < 1e-9, "{durations} {seconds}");
        let governed = report["time"]["governed"].as_object().unwrap();
        let share: f64 = governed.iter().filter(|(name, _)| name.starts_with(governor)).map(number).sum();
        let all: f64 = governed.iter().map(number).sum();
        assert!(share > 0.9 && (all - 1.0).abs() < 1e-9, "{governed:?}");
    }
}

fn number((_, value): (&String, &Value)) -> f64 {
    value.as_f64().unwrap()
}
