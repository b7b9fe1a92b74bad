//! Headers for browsers: CORS, and the policies of pages.

use axum::Router;
use axum::body::Body;
use axum::http::header::{
    ACCESS_CONTROL_ALLOW_HEADERS, ACCESS_CONTROL_ALLOW_METHODS, ACCESS_CONTROL_ALLOW_ORIGIN,
    ACCESS_CONTROL_EXPOSE_HEADERS, ACCESS_CONTROL_REQUEST_HEADERS, ACCESS_CONTROL_REQUEST_METHOD, ORIGIN,
    SERVER, VARY,
};
use axum::http::{HeaderMap, Method, Request};

use super::{get, get_from, opened, send_to, service, settings};

const QUESTION: &str = "/ik?frame=platform&x=-240&y=-86&z=1000";

/// Answers of every kind: a page, its files, the docs, an answer, failures.
const URIS: [&str; 6] = ["/", "/docs/", "/docs/swagger-ui.css", QUESTION, "/nowhere", "/fk?rho=x"];

async fn allowing(origins: &str) -> Router {
    opened(&settings(&format!("--memory-only --cors-origin {origins}"))).await
}

async fn preflight(service: &Router, origin: &str) -> HeaderMap {
    let request = Request::builder()
        .method(Method::OPTIONS)
        .uri("/workspace")
        .header(ORIGIN, origin)
        .header(ACCESS_CONTROL_REQUEST_METHOD, "POST")
        .header(ACCESS_CONTROL_REQUEST_HEADERS, "content-type,prefer,authorization,traceparent")
        .body(Body::empty())
        .unwrap();
    send_to(service.clone(), request).await.headers
}

#[tokio::test]
async fn pages_of_other_origins_are_refused_by_default() {
    let service = service().await;
    assert!(!preflight(&service, "https://example.org").await.contains_key(ACCESS_CONTROL_ALLOW_ORIGIN));
    for uri in URIS {
        let reply = get_from(&service, uri, &[(ORIGIN, "https://example.org")]).await;
        assert!(!reply.headers.contains_key(ACCESS_CONTROL_ALLOW_ORIGIN), "{uri}");
    }
}

#[tokio::test]
async fn pages_of_configured_origins_are_allowed() {
    let service = allowing("https://one.example,https://two.example:8443").await;
    for origin in ["https://one.example", "https://two.example:8443"] {
        let told = preflight(&service, origin).await;
        assert_eq!(told[ACCESS_CONTROL_ALLOW_ORIGIN], origin);
        assert!(told[ACCESS_CONTROL_ALLOW_METHODS].to_str().unwrap().contains("DELETE"));
        let headers = told[ACCESS_CONTROL_ALLOW_HEADERS].to_str().unwrap();
        for header in
            ["content-type", "content-encoding", "prefer", "authorization", "traceparent", "tracestate"]
        {
            assert!(headers.contains(header), "{headers}");
        }
        for uri in URIS {
            let reply = get_from(&service, uri, &[(ORIGIN, origin)]).await;
            assert_eq!(reply.headers[ACCESS_CONTROL_ALLOW_ORIGIN], origin, "{uri}");
            let exposed = reply.headers[ACCESS_CONTROL_EXPOSE_HEADERS].to_str().unwrap();
            for header in ["location", "retry-after", "etag", "x-request-id"] {
                assert!(exposed.contains(header), "{exposed}");
            }
            // An isolated page may load answers of the API, but not the service's own pages.
            let page = uri == "/" || uri.starts_with("/docs/");
            let loaded_by = if page { "same-origin" } else { "cross-origin" };
            assert_eq!(reply.headers["cross-origin-resource-policy"], loaded_by, "{uri}");
            let mut vary = reply.headers.get_all(VARY).iter();
            assert!(vary.any(|vary| vary.to_str().unwrap().contains("origin")), "caches tell origins apart");
        }
    }
    for origin in ["https://three.example", "https://two.example", "http://one.example", "null"] {
        assert!(!preflight(&service, origin).await.contains_key(ACCESS_CONTROL_ALLOW_ORIGIN), "{origin}");
    }
}

#[tokio::test]
async fn a_wildcard_allows_pages_of_all_origins() {
    let service = allowing("*").await;
    assert_eq!(preflight(&service, "https://example.org").await[ACCESS_CONTROL_ALLOW_ORIGIN], "*");
    let reply = get_from(&service, QUESTION, &[(ORIGIN, "https://example.org")]).await;
    assert_eq!(reply.headers[ACCESS_CONTROL_ALLOW_ORIGIN], "*");
}

#[tokio::test]
async fn every_answer_forbids_sniffing_and_framing() {
    for uri in URIS {
        let headers = get(uri).await.headers;
        assert_eq!(headers["x-content-type-options"], "nosniff", "{uri}");
        assert_eq!(headers["cross-origin-resource-policy"], "same-origin", "{uri}");
        let policy = headers["content-security-policy"].to_str().unwrap();
        assert!(policy.starts_with("default-src 'none';"), "{uri}: {policy}");
        assert!(policy.contains("frame-ancestors 'none'"), "{uri}: {policy}");
        assert!(!policy.contains("unsafe-eval") && !policy.contains("script-src 'self' "), "{uri}: {policy}");
        assert!(!headers.contains_key("strict-transport-security"), "{uri}: not without TLS");
        assert!(!headers.contains_key(SERVER), "{uri}");
    }
}

#[tokio::test]
async fn pages_have_restrictive_policies() {
    for uri in ["/", "/docs/"] {
        let headers = get(uri).await.headers;
        assert_eq!(headers["referrer-policy"], "no-referrer", "{uri}");
        assert_eq!(headers["cross-origin-opener-policy"], "same-origin", "{uri}");
        assert!(headers["permissions-policy"].to_str().unwrap().contains("camera=()"), "{uri}");
        let policy = headers["content-security-policy"].to_str().unwrap();
        for part in ["base-uri 'none'", "form-action 'none'", "script-src 'self';", "connect-src 'self'"] {
            assert!(policy.contains(part), "{uri}: {policy}");
        }
    }
    let viewer = get("/").await.headers["content-security-policy"].clone();
    assert!(!viewer.to_str().unwrap().contains("unsafe"), "{viewer:?}");
}
