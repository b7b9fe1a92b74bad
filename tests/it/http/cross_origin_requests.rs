//! Requests from pages of other origins: they start no work.

use axum::Router;
use axum::body::Body;
use axum::http::header::{CONTENT_TYPE, HOST, ORIGIN};
use axum::http::{HeaderName, Method, Request, StatusCode};

use super::{Reply, opened, send_to, service, settings};

const SITE: HeaderName = HeaderName::from_static("sec-fetch-site");

/// Requests that start or end work: GET, POST and DELETE.
const WORK: [(Method, &str, &str); 5] = [
    (Method::GET, "/workspace?tolerance=50", ""),
    (Method::POST, "/workspace", r#"{"tolerance": 50}"#),
    (Method::POST, "/fk", r#"{"joints": {"rho": [674, 685, 250]}}"#),
    (Method::POST, "/ik/batch", r#"{"frame": "platform", "poses": [[0, 0, 1200]]}"#),
    (Method::DELETE, "/jobs/0000000000000000000000000000000000000000000000000000000000000000", ""),
];

type Headers<'a> = &'a [(HeaderName, &'a str)];

async fn send(service: &Router, (method, uri, body): (Method, &str, &str), headers: Headers<'_>) -> Reply {
    let mut request = Request::builder().method(method).uri(uri).header(CONTENT_TYPE, "application/json");
    for (name, value) in headers {
        request = request.header(name, *value);
    }
    send_to(service.clone(), request.body(Body::from(body.to_owned())).unwrap()).await
}

/// The statuses of all that starts work.
async fn statuses(service: &Router, headers: Headers<'_>) -> Vec<u16> {
    let mut statuses = Vec::new();
    for work in WORK {
        let reply = send(service, work, headers).await;
        if reply.status == StatusCode::FORBIDDEN {
            reply.assert_problem(403, "other_origin");
        }
        statuses.push(reply.status.as_u16());
    }
    statuses
}

const DONE: [u16; 5] = [200, 200, 200, 200, 404];
const REFUSED: [u16; 5] = [403; 5];

#[tokio::test]
async fn pages_of_other_origins_cannot_start_jobs() {
    let service = service().await;
    let host = (HOST, "localhost:8080");
    for (headers, expected) in [
        // No browser.
        (&[] as Headers<'_>, DONE),
        // The service's own pages, and what a user has typed.
        (&[(SITE, "same-origin"), (ORIGIN, "http://localhost:8080")], DONE),
        (&[(SITE, "none")], DONE),
        // Images have no origin; a form's may be hidden.
        (&[(SITE, "cross-site")], REFUSED),
        (&[(SITE, "same-site"), (ORIGIN, "http://localhost:3000")], REFUSED),
        (&[(SITE, "cross-site"), (ORIGIN, "https://example.org")], REFUSED),
        (&[(SITE, "cross-site"), (ORIGIN, "null")], REFUSED),
        (&[(SITE, "something-new")], REFUSED),
        // Old browsers, and those that are asked for an address without TLS.
        (&[(ORIGIN, "http://localhost:8080")], DONE),
        (&[(ORIGIN, "http://localhost")], REFUSED),
        (&[(ORIGIN, "http://localhost:3000")], REFUSED),
        (&[(ORIGIN, "https://example.org")], REFUSED),
        (&[(ORIGIN, "null")], REFUSED),
    ] {
        let headers = [headers, std::slice::from_ref(&host)].concat();
        assert_eq!(statuses(&service, &headers).await, expected, "{headers:?}");
    }
    // Public pages can be read: other pages may link to them.
    for uri in ["/", "/docs/", "/machines", "/fk?rho=674,685,250", "/openapi.json"] {
        let reply = send(&service, (Method::GET, uri, ""), &[host.clone(), (SITE, "cross-site")]).await;
        assert_eq!(reply.status, StatusCode::OK, "{uri}");
    }
}

#[tokio::test]
async fn pages_of_configured_origins_can_start_jobs() {
    let service = opened(&settings("--memory-only --cors-origin https://cam.example")).await;
    let from = |origin| [(SITE, "cross-site"), (ORIGIN, origin)];
    assert_eq!(statuses(&service, &from("https://cam.example")).await, DONE);
    assert_eq!(statuses(&service, &from("https://cam.example:8443")).await, REFUSED);
    assert_eq!(statuses(&service, &[(ORIGIN, "https://cam.example")]).await, DONE);
    let service = opened(&settings("--memory-only --cors-origin *")).await;
    assert_eq!(statuses(&service, &from("https://other.example")).await, DONE);
}

async fn status_at(service: &Router, host: &str, path: &str) -> u16 {
    let reply = send(service, (Method::GET, path, ""), &[(HOST, host)]).await;
    if reply.status == StatusCode::MISDIRECTED_REQUEST {
        reply.assert_problem(421, "host_not_allowed");
    }
    reply.status.as_u16()
}

#[tokio::test]
async fn an_unknown_host_name_is_refused() {
    let service = service().await;
    for path in ["/", "/docs/", "/jobs", "/machines", "/openapi.json", "/metrics", "/workspace?tolerance=50"]
    {
        for host in [
            "localhost",
            "LOCALHOST:8080",
            "verne.localhost",
            "localhost.",
            "127.0.0.1:8080",
            "[::1]:80",
            "10.0.0.1",
        ] {
            assert_eq!(status_at(&service, host, path).await, 200, "{host} {path}");
        }
        for host in [
            "example.org",
            "evil.example:8080",
            "127.0.0.1.evil.example",
            "notlocalhost",
            "localhost.evil.example",
        ] {
            assert_eq!(status_at(&service, host, path).await, 421, "{host} {path}");
        }
    }
    assert_eq!(status_at(&service, "evil.example", "/nowhere").await, 421);
    // A probe tells nothing.
    assert_eq!(status_at(&service, "probe.example", "/livez").await, 200);
}

#[tokio::test]
async fn configured_host_names_are_accepted() {
    let named = opened(&settings("--memory-only --allowed-host Verne.example.org,verne")).await;
    let public = opened(&settings("--memory-only --listen 0.0.0.0:0")).await;
    let public_named = opened(&settings("--memory-only --listen 0.0.0.0:0 --allowed-host verne")).await;
    let any = opened(&settings("--memory-only --allowed-host *")).await;
    for (host, expected) in [
        ("verne.example.org", [200, 200, 421, 200]),
        ("verne:8080", [200, 200, 200, 200]),
        ("localhost", [200, 200, 200, 200]),
        ("10.1.2.3:8080", [200, 200, 200, 200]),
        ("other.example", [421, 200, 421, 200]),
    ] {
        for (service, expected) in [&named, &public, &public_named, &any].into_iter().zip(expected) {
            assert_eq!(status_at(service, host, "/machines").await, expected, "{host}");
        }
    }
    // Behind a proxy that sends its own name in Host, the names that are given are those of pages.
    let from = |origin| [(HOST, "127.0.0.1:8080"), (ORIGIN, origin)];
    assert_eq!(statuses(&named, &from("https://verne.example.org")).await, DONE);
    assert_eq!(statuses(&named, &from("https://evil.example")).await, REFUSED);
}
