//! Behind a proxy: under its path, and for its clients.

use std::net::SocketAddr;

use axum::Router;
use axum::body::Body;
use axum::extract::ConnectInfo;
use axum::http::header::{CONTENT_LOCATION, LOCATION};
use axum::http::{Method, Request, StatusCode};
use serde_json::json;

use super::jobs::preferring;
use super::{Reply, get_from, json_request, opened, send_to, settings};

async fn published() -> Router {
    opened(&settings("--memory-only --base-path /tools/verne")).await
}

/// The path of a link, without what the proxy publishes the service under.
fn below(link: &serde_json::Value) -> String {
    let link = link.as_str().unwrap();
    link.strip_prefix("/tools/verne/").unwrap_or_else(|| panic!("{link}")).to_owned()
}

#[tokio::test]
async fn links_contain_the_published_address() {
    let service = published().await;
    for question in
        [json!({"tolerance": 50}), json!({"kind": "tool", "tolerance": 60, "tool_length": [10, 20]})]
    {
        let answer = send_to(service.clone(), json_request(Method::POST, "/workspace", &question)).await;
        assert_eq!(answer.status, StatusCode::OK, "{}", answer.json);
        let summary = &answer.json;
        assert_eq!(answer.headers[CONTENT_LOCATION], *summary["links"]["self"].as_str().unwrap());
        // With its path and without it, as the proxy may have it.
        for link in summary["links"].as_object().unwrap().values() {
            for uri in [link.as_str().unwrap().to_owned(), format!("/{}", below(link))] {
                let found = get_from(&service, &uri, &[]).await;
                assert_eq!(found.status, StatusCode::OK, "{uri}: {}", found.json);
                assert!(
                    found.headers[CONTENT_LOCATION].to_str().unwrap().starts_with("/tools/verne/"),
                    "{uri}"
                );
            }
        }
        let job = format!("/tools/verne/jobs/{}", summary["id"].as_str().unwrap());
        let job = get_from(&service, &job, &[]).await.json;
        assert_eq!(job["result"], summary["links"]["self"]);
        assert_eq!(job["links"]["events"], format!("{}/events", job["links"]["self"].as_str().unwrap()));
        let events = get_from(&service, job["links"]["events"].as_str().unwrap(), &[]).await;
        assert!(String::from_utf8(events.bytes).unwrap().contains("\"self\":\"/tools/verne/jobs/"));
    }
    let accepted = send_to(service.clone(), preferring("respond-async", &json!({"tolerance": 41}))).await;
    assert_eq!(accepted.headers[LOCATION], *accepted.json["links"]["self"].as_str().unwrap());
    below(&accepted.json["links"]["self"]);
    let listed = get_from(&service, "/tools/verne/jobs", &[]).await.json;
    below(&listed["jobs"][0]["links"]["self"]);
}

#[tokio::test]
async fn pages_and_document_work_below_a_path() {
    let service = published().await;
    let page = get_from(&service, "/tools/verne", &[]).await;
    assert_eq!(
        (page.status, &page.headers[LOCATION]),
        (StatusCode::PERMANENT_REDIRECT, &"/tools/verne/".parse().unwrap())
    );
    let docs = get_from(&service, "/tools/verne/docs", &[]).await;
    assert_eq!(docs.headers[LOCATION], "/tools/verne/docs/");
    for path in ["/tools/verne/", "/", "/tools/verne/docs/", "/tools/verne/livez", "/livez"] {
        assert_eq!(get_from(&service, path, &[]).await.status, StatusCode::OK, "{path}");
    }
    let script = get_from(&service, "/tools/verne/docs/swagger-initializer.js", &[]).await;
    assert!(String::from_utf8(script.bytes).unwrap().contains("\"/tools/verne/openapi.json\""));
    let document = get_from(&service, "/tools/verne/openapi.json", &[]).await.json;
    assert_eq!(document["servers"][0]["url"], "/tools/verne");
    for path in ["/tools/verne2/machines", "/verne/machines", "/tools/verne/tools/verne/machines"] {
        get_from(&service, path, &[]).await.assert_problem(404, "not_found");
    }
}

async fn asked(service: &Router, peer: &str, forwarded: &str) -> Reply {
    let mut request =
        Request::get("/machines").header("x-forwarded-for", forwarded).body(Body::empty()).unwrap();
    request.extensions_mut().insert(ConnectInfo(SocketAddr::new(peer.parse().unwrap(), 4000)));
    send_to(service.clone(), request).await
}

#[tokio::test]
async fn clients_behind_a_trusted_proxy_are_distinguished() {
    let flags = "--memory-only --rate 1 --rate-burst 1 --trusted-proxy 10.0.0.0/8,fd00::/8";
    let service = opened(&settings(flags)).await;
    let exhausted = async |peer: &str, forwarded: &str| {
        for _ in 0..1000 {
            if asked(&service, peer, forwarded).await.status == StatusCode::TOO_MANY_REQUESTS {
                return;
            }
        }
        panic!("{peer} {forwarded} is never refused");
    };
    exhausted("10.0.0.1", "192.0.2.1").await;
    // Entries of the client and of other proxies before the trusted one do not count.
    exhausted("10.0.0.2", "198.51.100.7, 192.0.2.1, 10.0.0.9").await;
    assert_eq!(asked(&service, "10.0.0.1", "192.0.2.2").await.status, StatusCode::OK);
    assert_eq!(asked(&service, "fd00::1", "192.0.2.3").await.status, StatusCode::OK);
    // Others' words do not count.
    exhausted("203.0.113.5", "192.0.2.4").await;
    assert_eq!(asked(&service, "10.0.0.1", "192.0.2.4").await.status, StatusCode::OK);
    exhausted("203.0.113.5", "192.0.2.5").await;
}
