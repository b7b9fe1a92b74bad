//! Results under their ids: entity tags, 304, ranges, unknown ids.

use axum::http::header::{
    ACCEPT, ACCEPT_ENCODING, ACCEPT_RANGES, CACHE_CONTROL, CONTENT_ENCODING, CONTENT_LENGTH, CONTENT_RANGE,
    CONTENT_TYPE, ETAG, IF_NONE_MATCH, IF_RANGE, RANGE, VARY,
};
use axum::http::{Request, StatusCode};
use axum::{Router, body::Body};
use serde_json::json;
use verne_service::ServeConfig;

use super::workspace::ask;
use super::{config, get, get_from, opened, send_to, service};

async fn computed() -> (Router, String) {
    let service = service().await;
    let summary = ask(&service, json!({"kind": "part", "tool_length": 50, "tolerance": 5})).await.json;
    let mesh = summary["links"]["mesh"].as_str().unwrap().to_owned();
    (service, mesh)
}

#[tokio::test]
async fn a_result_has_the_same_bytes_every_time() {
    let (service, mesh) = computed().await;
    let (again, _) = computed().await;
    let first = get_from(&service, &mesh, &[]).await;
    assert_eq!(first.headers[CONTENT_TYPE], "model/gltf-binary");
    assert_eq!(first.headers[CACHE_CONTROL], "public, max-age=31536000, immutable");
    assert!(first.headers.get_all(VARY).iter().any(|vary| vary == "accept"));
    let tag = first.headers[ETAG].to_str().unwrap();
    assert!(tag.starts_with('"'), "{tag} is strong");
    for other in [get_from(&service, &mesh, &[]).await, get_from(&again, &mesh, &[]).await] {
        assert_eq!(first.bytes, other.bytes);
        assert_eq!(other.headers[ETAG], tag);
    }
    let itself = mesh.strip_suffix("/mesh").unwrap();
    let summaries = [get_from(&service, itself, &[]).await, get_from(&again, itself, &[]).await];
    assert_eq!(summaries[0].bytes, summaries[1].bytes);
    assert_eq!(summaries[0].headers[CACHE_CONTROL], "public, max-age=31536000, immutable");
    assert_eq!(summaries[0].json["links"]["mesh"], mesh);
}

#[tokio::test]
async fn each_format_has_its_own_etag() {
    let (service, mesh) = computed().await;
    let mut tags = Vec::new();
    for accept in ["model/gltf-binary", "model/stl", "model/ply", "application/json"] {
        let reply = get_from(&service, &mesh, &[(ACCEPT, accept)]).await;
        assert_eq!(reply.headers[CONTENT_TYPE], accept);
        tags.push(reply.headers[ETAG].clone());
    }
    for (i, tag) in tags.iter().enumerate() {
        assert!(!tags[..i].contains(tag));
    }
}

#[tokio::test]
async fn a_known_etag_is_answered_with_304() {
    let (service, mesh) = computed().await;
    let tag = get_from(&service, &mesh, &[]).await.headers[ETAG].to_str().unwrap().to_owned();
    for condition in [tag.clone(), format!("\"other\", {tag}"), "*".to_owned(), format!("W/{tag}")] {
        let reply = get_from(&service, &mesh, &[(IF_NONE_MATCH, &condition)]).await;
        assert_eq!(reply.status, StatusCode::NOT_MODIFIED, "{condition}");
        assert_eq!((reply.bytes.len(), &reply.headers[ETAG]), (0, &tag.parse().unwrap()));
        assert!(reply.headers.contains_key(CACHE_CONTROL));
    }
    let changed = get_from(&service, &mesh, &[(IF_NONE_MATCH, "\"other\"")]).await;
    assert_eq!(changed.status, StatusCode::OK);
}

#[tokio::test]
async fn a_range_request_returns_the_range() {
    let (service, mesh) = computed().await;
    let whole = get_from(&service, &mesh, &[]).await;
    assert_eq!(whole.headers[ACCEPT_RANGES], "bytes");
    let length = whole.bytes.len();
    let mut joined = Vec::new();
    for range in ["bytes=0-99", "bytes=100-"] {
        let reply = get_from(&service, &mesh, &[(RANGE, range)]).await;
        assert_eq!(reply.status, StatusCode::PARTIAL_CONTENT);
        assert!(reply.headers[CONTENT_RANGE].to_str().unwrap().ends_with(&format!("/{length}")));
        joined.extend(reply.bytes);
    }
    assert_eq!(joined, whole.bytes);
    let tag = whole.headers[ETAG].to_str().unwrap();
    for (condition, status) in [
        (tag, StatusCode::PARTIAL_CONTENT),
        ("\"other\"", StatusCode::OK),
        // An invalid range is ignored.
        ("other", StatusCode::OK),
        ("", StatusCode::OK),
    ] {
        let reply = get_from(&service, &mesh, &[(RANGE, "bytes=0-9"), (IF_RANGE, condition)]).await;
        assert_eq!(reply.status, status);
    }
    let beyond = get_from(&service, &mesh, &[(RANGE, &format!("bytes={length}-"))]).await;
    beyond.assert_problem(416, "range_not_satisfiable");
    assert_eq!(beyond.headers[CONTENT_RANGE], format!("bytes */{length}"));
    let several = get_from(&service, &mesh, &[(RANGE, "bytes=0-1,4-5")]).await;
    assert_eq!((several.status, several.bytes.len()), (StatusCode::OK, length));
}

#[tokio::test]
async fn a_result_larger_than_memory_is_sent_from_disk() {
    let data = tempfile::tempdir().unwrap();
    let directory = Some(data.path().to_path_buf());
    let on_disk = ServeConfig { memory_only: false, data: directory, cache_bytes: 0, ..config(None) };
    let disk = opened(&on_disk).await;
    let question = json!({"kind": "part", "tool_length": 50, "tolerance": 0.1});
    let summary = ask(&disk, question.clone()).await.json;
    let mesh = format!("{}?format=stl", summary["links"]["mesh"].as_str().unwrap());
    get_from(&disk, &mesh, &[]).await;
    let whole = get_from(&disk, &mesh, &[]).await;
    let length = whole.bytes.len();
    assert!(length > 3 << 19, "{length} bytes: of several chunks");
    assert_eq!(whole.headers[CONTENT_LENGTH], length.to_string());
    let part = get_from(&disk, &mesh, &[(RANGE, "bytes=1048570-1048580")]).await;
    assert_eq!(
        (part.status, part.bytes.as_slice()),
        (StatusCode::PARTIAL_CONTENT, &whole.bytes[1_048_570..=1_048_580])
    );

    let memory = service().await;
    ask(&memory, question).await;
    let same = get_from(&memory, &mesh, &[]).await;
    assert!(same.bytes == whole.bytes && same.headers[ETAG] == whole.headers[ETAG]);
}

#[tokio::test]
async fn head_returns_the_length_and_no_range() {
    let (service, mesh) = computed().await;
    let whole = get_from(&service, &mesh, &[]).await;
    let head = Request::head(&mesh).header(RANGE, "bytes=0-9").body(Body::empty()).unwrap();
    let reply = send_to(service, head).await;
    assert_eq!((reply.status, reply.bytes.len()), (StatusCode::OK, 0));
    assert_eq!(reply.headers[CONTENT_LENGTH], whole.bytes.len().to_string());
    assert_eq!(reply.headers[ETAG], whole.headers[ETAG]);
}

#[tokio::test]
async fn answers_with_an_etag_are_not_compressed() {
    let (service, mesh) = computed().await;
    let plain = get_from(&service, &mesh, &[]).await;
    for uri in [format!("{mesh}?format=json"), mesh.clone()] {
        let reply = get_from(&service, &uri, &[(ACCEPT_ENCODING, "gzip, br, zstd")]).await;
        assert!(!reply.headers.contains_key(CONTENT_ENCODING), "{uri}");
    }
    let part = get_from(&service, &mesh, &[(ACCEPT_ENCODING, "gzip"), (RANGE, "bytes=0-9")]).await;
    assert_eq!(part.bytes, plain.bytes[..10]);
}

#[tokio::test]
async fn an_unknown_id_is_a_problem_with_advice() {
    let id = "0".repeat(64);
    for path in ["", "/mesh", "/mesh?format=stl", "/slice?z=3"] {
        let reply = get(&format!("/workspace/{id}{path}")).await;
        reply.assert_problem(404, "workspace_not_found");
        assert!(reply.json["detail"].as_str().unwrap().contains("repeat the request"));
    }
    get("/workspace/contains").await.assert_problem(405, "method_not_allowed");
    let accept = get_from(&service().await, &format!("/workspace/{id}"), &[(ACCEPT, "image/png")]).await;
    accept.assert_problem(406, "not_acceptable");
}
