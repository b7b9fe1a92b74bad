//! The viewer: the page and its files, or a sentence in a binary without them.

use axum::http::{StatusCode, header};

use super::{get, get_from, service};

#[tokio::test]
async fn the_root_is_the_viewer_or_explains_how_to_build_it() {
    let page = get("/").await;
    assert_eq!(page.status, StatusCode::OK);
    let text = String::from_utf8(page.bytes).unwrap();
    if page.headers[header::CONTENT_TYPE].to_str().unwrap().starts_with("text/plain") {
        assert!(text.contains("Node.js") && text.contains("cargo build"), "{text}");
    } else {
        assert_eq!(page.headers[header::CONTENT_TYPE], "text/html; charset=utf-8");
        let service = service().await;
        let tag = page.headers[header::ETAG].to_str().unwrap();
        let again = get_from(&service, "/", &[(header::IF_NONE_MATCH, tag)]).await;
        assert_eq!(again.status, StatusCode::NOT_MODIFIED);
        let assets = text.split('"').filter_map(|word| word.strip_prefix("./")).collect::<Vec<_>>();
        assert!(assets.len() >= 3, "{text}");
        for asset in assets {
            let file = get_from(&service, &format!("/{asset}"), &[(header::ACCEPT_ENCODING, "br")]).await;
            assert_eq!(file.status, StatusCode::OK, "{asset}");
            assert!(file.headers[header::CACHE_CONTROL].to_str().unwrap().contains("immutable"), "{asset}");
            let media = file.headers[header::CONTENT_TYPE].to_str().unwrap();
            let wanted = match asset.rsplit_once('.').unwrap().1 {
                "js" => "text/javascript; charset=utf-8",
                "css" => "text/css; charset=utf-8",
                _ => "image/svg+xml",
            };
            assert_eq!(media, wanted, "{asset}");
            assert_eq!(file.headers[header::CONTENT_ENCODING], "br", "{asset}");
            assert_eq!(file.headers[header::VARY], "accept-encoding", "{asset}");
        }
    }
}

#[tokio::test]
async fn a_missing_viewer_file_is_a_problem() {
    for path in ["/assets/none.js", "/assets/..%2Findex.html", "/assets/%ff", "/index.html"] {
        let reply = get(path).await;
        assert_eq!(reply.status, StatusCode::NOT_FOUND, "{path}");
        assert_eq!(reply.headers[header::CONTENT_TYPE], "application/problem+json", "{path}");
        assert_eq!(reply.json["code"], "not_found", "{path}");
    }
}
