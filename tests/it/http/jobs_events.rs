//! Events as a browser's EventSource reads them: it reconnects after every end except a 204.

use axum::Router;
use axum::http::{HeaderName, StatusCode};
use serde_json::{Value, json};

use super::jobs::{cancel, long, one_core, small, start};
use super::{get_from, opened, service};

const LAST_EVENT_ID: HeaderName = HeaderName::from_static("last-event-id");

/// The fields of an event.
#[derive(Debug, Default)]
struct Event {
    id: String,
    name: String,
    data: Value,
}

/// All events from now to the last.
async fn events(service: &Router, id: &str) -> Vec<Event> {
    let reply = get_from(service, &format!("/jobs/{id}/events"), &[]).await;
    assert_eq!((reply.status, &reply.headers["x-accel-buffering"]), (StatusCode::OK, &"no".parse().unwrap()));
    let text = String::from_utf8(reply.bytes).unwrap();
    let event = |text: &str| {
        let field = |name| text.lines().find_map(|line| line.strip_prefix(name)).unwrap_or_default();
        let data = serde_json::from_str(field("data: ")).unwrap();
        Event { id: field("id: ").to_owned(), name: field("event: ").to_owned(), data }
    };
    text.split("\n\n").filter(|text| !text.is_empty() && !text.starts_with(':')).map(event).collect()
}

/// The status for a client that has events up to this one.
async fn again(service: &Router, id: &str, last: &str) -> StatusCode {
    get_from(service, &format!("/jobs/{id}/events"), &[(LAST_EVENT_ID, last)]).await.status
}

#[tokio::test]
async fn the_last_event_ends_reconnection() {
    let service = service().await;
    let id = start(&service, &small(50)).await;
    let events = events(&service, &id).await;
    let [.., last, end] = events.as_slice() else { panic!("{events:?}") };
    assert_eq!((end.name.as_str(), &end.id), ("end", &last.id));
    assert_eq!((&end.data, &end.data["state"]), (&last.data, &json!("succeeded")));
    for event in events.iter().rev().skip(1) {
        assert_eq!(event.name, "", "an EventSource has these without asking for their name");
        assert!(!event.id.is_empty());
    }
    assert_eq!(again(&service, &id, &end.id).await, StatusCode::NO_CONTENT);
    for other in ["running-0.5", "succeeded", ""] {
        assert_eq!(again(&service, &id, other).await, StatusCode::OK, "{other}: the end is told");
    }
    let unknown = format!("/jobs/{}/events", "0".repeat(64));
    get_from(&service, &unknown, &[(LAST_EVENT_ID, &end.id)]).await.assert_problem(404, "job_not_found");
}

#[tokio::test]
async fn a_restarted_job_sends_events_to_clients_that_saw_its_first_end() {
    let service = opened(&one_core()).await;
    let id = start(&service, &long(0)).await;
    cancel(&service, &id).await;
    let first = events(&service, &id).await.pop().unwrap();
    assert_eq!((first.name.as_str(), &first.data["state"]), ("end", &json!("cancelled")));
    assert_eq!(again(&service, &id, &first.id).await, StatusCode::NO_CONTENT);
    assert_eq!(start(&service, &long(0)).await, id);
    cancel(&service, &id).await;
    let second = events(&service, &id).await.pop().unwrap();
    assert_ne!(first.id, second.id);
    assert_eq!(again(&service, &id, &first.id).await, StatusCode::OK);
}
