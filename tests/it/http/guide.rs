//! The guide: its pages and files, also below the path of a proxy.

use axum::http::{StatusCode, header};

use super::{get, get_from, opened, service, settings};

#[tokio::test]
async fn the_guide_begins_with_a_page_that_browsers_revalidate() {
    let page = get("/guide/").await;
    assert_eq!(page.status, StatusCode::OK);
    if page.headers[header::CONTENT_TYPE].to_str().unwrap().starts_with("text/plain") {
        // Built with VERNE_GUIDE=skip.
        assert!(String::from_utf8(page.bytes).unwrap().contains("VERNE_GUIDE"));
        return;
    }
    assert_eq!(page.headers[header::CONTENT_TYPE], "text/html; charset=utf-8");
    assert_eq!(page.headers[header::CACHE_CONTROL], "no-cache");
    let service = service().await;
    let tag = page.headers[header::ETAG].to_str().unwrap();
    let again = get_from(&service, "/guide/", &[(header::IF_NONE_MATCH, tag)]).await;
    assert_eq!(again.status, StatusCode::NOT_MODIFIED);
    let text = String::from_utf8(page.bytes).unwrap();
    assert!(!text.contains("<script>"), "the policy forbids scripts in pages");
    let policy = page.headers["content-security-policy"].to_str().unwrap();
    assert!(policy.contains("script-src 'self';") && !policy.contains("unsafe-eval"), "{policy}");

    for (path, media) in [
        ("/guide/limits.html", "text/html; charset=utf-8"),
        ("/guide/limits/stroke.svg", "image/svg+xml"),
        ("/guide/workspace.png", "image/png"),
        ("/guide/start/curl.html", "text/html; charset=utf-8"),
    ] {
        let file = get_from(&service, path, &[]).await;
        assert_eq!(
            (file.status, &file.headers[header::CONTENT_TYPE]),
            (StatusCode::OK, &media.parse().unwrap())
        );
    }
    let limits = get_from(&service, "/guide/limits.html", &[(header::ACCEPT_ENCODING, "br")]).await;
    assert_eq!(limits.headers[header::CONTENT_ENCODING], "br");
}

#[tokio::test]
async fn the_address_without_a_slash_leads_to_the_guide() {
    assert_eq!(get("/guide").await.headers[header::LOCATION], "/guide/");
    let below = opened(&settings("--memory-only --base-path /verne")).await;
    assert_eq!(get_from(&below, "/verne/guide", &[]).await.headers[header::LOCATION], "/verne/guide/");
    let document = get_from(&below, "/verne/openapi.json", &[]).await;
    assert_eq!(document.json["externalDocs"]["url"], "/verne/guide/");
}

#[tokio::test]
async fn a_missing_page_of_the_guide_is_a_problem() {
    for path in ["/guide/none.html", "/guide/..%2Findex.html", "/guide/%ff", "/guide/limits.py"] {
        let reply = get(path).await;
        assert_eq!(reply.status, StatusCode::NOT_FOUND, "{path}");
        assert_eq!(reply.json["code"], "not_found", "{path}");
    }
}
