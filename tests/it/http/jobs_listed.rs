//! GET /jobs: pages and states.

use axum::Router;
use axum::body::Body;
use axum::http::Request;
use axum::http::header::CACHE_CONTROL;
use serde_json::Value;

use super::jobs::{cancel, job, long, one_core, small, start};
use super::workspace::ask;
use super::{get, get_from, opened, send, service};

async fn page(service: &Router, query: &str) -> (Vec<String>, Option<String>) {
    let reply = get_from(service, &format!("/jobs?{query}"), &[]).await;
    assert_eq!(reply.headers[CACHE_CONTROL], "no-store");
    let ids = reply.json["jobs"].as_array().unwrap().iter().map(|job| job["id"].as_str().unwrap().to_owned());
    (ids.collect(), reply.json["next"].as_str().map(str::to_owned))
}

#[tokio::test]
async fn pages_list_every_job_once_newest_first() {
    let service = service().await;
    assert_eq!(page(&service, "").await, (vec![], None));
    let mut asked = Vec::new();
    for tool_length in 0..5 {
        let id = ask(&service, small(tool_length)).await.json["id"].as_str().unwrap().to_owned();
        asked.insert(0, id);
    }
    let (first, next) = page(&service, "limit=2").await;
    let (second, next) = page(&service, &format!("limit=2&after={}", next.unwrap())).await;
    let (third, next) = page(&service, &format!("limit=2&after={}", next.unwrap())).await;
    assert_eq!([first, second, third].concat(), asked);
    assert_eq!(next, None);
    assert_eq!(page(&service, "").await, (asked, None));
}

#[tokio::test]
async fn jobs_can_be_filtered_by_state() {
    let service = opened(&one_core()).await;
    let succeeded = ask(&service, small(50)).await.json["id"].as_str().unwrap().to_owned();
    let running = start(&service, &long(0)).await;
    let [cancelled, queued] = [start(&service, &long(100)).await, start(&service, &long(200)).await];
    cancel(&service, &cancelled).await;
    for (state, id) in
        [("succeeded", succeeded), ("running", running), ("cancelled", cancelled), ("queued", queued)]
    {
        assert_eq!(page(&service, &format!("state={state}")).await, (vec![id.clone()], None), "{state}");
        assert_eq!(job(&service, &id).await["state"], state);
    }
    assert_eq!(page(&service, "state=failed").await, (vec![], None));
}

#[tokio::test]
async fn a_listed_job_equals_the_job() {
    let service = service().await;
    let id = ask(&service, small(50)).await.json["id"].as_str().unwrap().to_owned();
    let last = super::jobs::events(&service, &id).await.pop().unwrap();
    let list: Value = get_from(&service, "/jobs", &[]).await.json;
    assert_eq!(list["jobs"][0], last);
}

#[tokio::test]
async fn a_problem_names_the_parameter_of_a_page() {
    for (query, pointer) in [
        ("limit=0", "/query/limit"),
        ("limit=101", "/query/limit"),
        ("limit=-1", "/query/limit"),
        ("after=x", "/query/after"),
        ("after=-1", "/query/after"),
        ("after=", "/query/after"),
        ("state=asleep", "/query/state"),
        ("client=me", "/query/client"),
    ] {
        get(&format!("/jobs?{query}")).await.assert_bad_field(pointer);
    }
}

#[tokio::test]
async fn an_unknown_job_is_404() {
    for id in
        ["0".repeat(64), "0".repeat(63), "A".repeat(64), "g".repeat(64), "%FF".to_owned(), "x%2Fy".to_owned()]
    {
        let code = if id == "%FF" { "not_found" } else { "job_not_found" };
        get(&format!("/jobs/{id}")).await.assert_problem(404, code);
        get(&format!("/jobs/{id}/events")).await.assert_problem(404, code);
        let request = Request::delete(format!("/jobs/{id}")).body(Body::empty()).unwrap();
        send(request).await.assert_problem(404, code);
    }
    let request = Request::post("/jobs").body(Body::empty()).unwrap();
    send(request).await.assert_problem(405, "method_not_allowed");
}
