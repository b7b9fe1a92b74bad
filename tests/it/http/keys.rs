//! API keys: which operations need one, and what each role allows.

use std::time::Duration;

use axum::Router;
use axum::body::Body;
use axum::http::header::{AUTHORIZATION, CACHE_CONTROL, WWW_AUTHENTICATE};
use axum::http::{HeaderValue, Method, Request, StatusCode};
use clap::Parser;
use http_body_util::BodyExt;
use serde_json::{Value, json};
use tempfile::TempDir;
use tower::ServiceExt;
use verne_service::{Cli, ServeConfig, Service};

use super::jobs::{long, one_core, preferring, small};
use super::{Reply, config, get, get_from, json_request, opened, send_to};

/// A fresh key as `verne key new` prints it, and its entry.
pub(super) fn fresh(name: &str, role: &str) -> (String, String) {
    let (mut entry, mut key) = (Vec::new(), Vec::new());
    let words = ["verne", "key", "new", "--name", name, "--role", role];
    Cli::try_parse_from(words).unwrap().run(&mut entry, &mut key, None).unwrap();
    (String::from_utf8(key).unwrap().trim_end().to_owned(), String::from_utf8(entry).unwrap())
}

/// A directory with a file of keys.
pub(super) struct Keys {
    place: TempDir,
    keys: Vec<String>,
}

impl Keys {
    /// With a key for each name and role.
    pub(super) fn new<const N: usize>(holders: [(&str, &str); N]) -> Self {
        let (keys, entries): (_, Vec<_>) = holders.map(|(name, role)| fresh(name, role)).into_iter().unzip();
        let made = Self { place: TempDir::new().unwrap(), keys };
        made.write(&entries.join("\n"));
        made
    }

    pub(super) fn write(&self, text: &str) {
        std::fs::write(self.file(), text).unwrap();
    }

    pub(super) fn file(&self) -> std::path::PathBuf {
        self.place.path().join("keys.toml")
    }

    pub(super) fn asked_for_by(&self, config: ServeConfig) -> ServeConfig {
        ServeConfig { keys: Some(self.file()), ..config }
    }

    /// The request, with the key of this number.
    pub(super) fn sent(&self, number: usize, mut request: Request<Body>) -> Request<Body> {
        let value = format!("Bearer {}", self.keys[number]);
        request.headers_mut().insert(AUTHORIZATION, HeaderValue::from_str(&value).unwrap());
        request
    }

    /// GET with the key of this number.
    pub(super) async fn get(&self, service: &Router, number: usize, uri: &str) -> Reply {
        let request = Request::get(uri).body(Body::empty()).unwrap();
        send_to(service.clone(), self.sent(number, request)).await
    }

    /// DELETE with the key of this number.
    pub(super) async fn delete(&self, service: &Router, number: usize, uri: &str) -> Reply {
        let request = Request::delete(uri).body(Body::empty()).unwrap();
        send_to(service.clone(), self.sent(number, request)).await
    }

    /// Has a question computed without waiting for it; the id.
    pub(super) async fn start(&self, service: &Router, number: usize, question: &Value) -> String {
        let reply = send_to(service.clone(), self.sent(number, preferring("respond-async", question))).await;
        assert_eq!(reply.status, StatusCode::ACCEPTED, "{}", reply.json);
        reply.json["id"].as_str().unwrap().to_owned()
    }
}

fn request(method: &str, path: &str) -> Request<Body> {
    let uri = path.replace("{id}", &"0".repeat(64)).replace("{name}", "verne");
    let method = Method::from_bytes(method.to_ascii_uppercase().as_bytes()).unwrap();
    Request::builder().method(method).uri(uri).body(Body::empty()).unwrap()
}

#[tokio::test]
async fn every_operation_except_the_open_ones_needs_a_key() {
    let keys = Keys::new([("cam", "admin")]);
    let service = opened(&keys.asked_for_by(config(None))).await;
    let document = get("/openapi.json").await.json;
    let mut open = Vec::new();
    for (path, operations) in document["paths"].as_object().unwrap() {
        for (method, operation) in operations.as_object().unwrap() {
            let reply = send_to(service.clone(), request(method, path)).await;
            if reply.status == StatusCode::OK {
                open.push(path.as_str());
                assert_eq!(operation["security"], json!([]), "{method} {path}");
                continue;
            }
            reply.assert_problem(401, "unauthorized");
            assert_eq!(reply.headers[WWW_AUTHENTICATE], "Bearer");
            assert_eq!(operation["security"], json!([{"bearer": []}, {}]), "{method} {path}");
            assert!(operation["responses"].get("401").is_some(), "{method} {path}");
            let unknown =
                send_to(service.clone(), Keys::new([("cam", "admin")]).sent(0, request(method, path)));
            unknown.await.assert_problem(401, "unauthorized");
            let known = send_to(service.clone(), keys.sent(0, request(method, path))).await;
            assert!(![401, 403].contains(&known.status.as_u16()), "{method} {path}: {}", known.json);
        }
    }
    open.sort_unstable();
    assert_eq!(open, ["/livez", "/openapi.json", "/readyz"]);
    for page in ["/", "/docs/"] {
        assert_eq!(get_from(&service, page, &[]).await.status, StatusCode::OK, "{page}");
    }
    // Nor does a method that a path does not have tell anything.
    let reply = send_to(service, Request::put("/fk").body(Body::empty()).unwrap()).await;
    reply.assert_problem(401, "unauthorized");
}

#[tokio::test]
async fn a_key_is_accepted_only_as_a_bearer_token() {
    let keys = Keys::new([("cam", "read")]);
    let service = opened(&keys.asked_for_by(config(None))).await;
    let key = &keys.keys[0];
    for header in [key.clone(), format!("Basic {key}"), format!("Bearer {key}0"), "Bearer".to_owned()] {
        let reply = get_from(&service, "/machines", &[(AUTHORIZATION, &header)]).await;
        reply.assert_problem(401, "unauthorized");
        assert!(!String::from_utf8(reply.bytes).unwrap().contains(&key[..20]), "a key is not repeated");
    }
    let reply = get_from(&service, "/machines", &[(AUTHORIZATION, &format!("bearer {key}"))]).await;
    assert_eq!(reply.status, StatusCode::OK);
}

#[tokio::test]
async fn a_role_allows_only_its_operations() {
    let keys = Keys::new([("reader", "read"), ("cam", "compute"), ("chief", "admin")]);
    let service = opened(&keys.asked_for_by(config(None))).await;
    let ask = |number, request| send_to(service.clone(), keys.sent(number, request));
    let fk = json!({"joints": {"rho": [674, 685, 250]}});
    for number in 0..3 {
        for uri in ["/fk?rho=674,685,250", "/machines", "/machines/schema", "/jobs", "/metrics"] {
            assert_eq!(keys.get(&service, number, uri).await.status, StatusCode::OK, "{uri}");
        }
        assert_eq!(ask(number, json_request(Method::POST, "/fk", &fk)).await.status, StatusCode::OK);
    }
    let workspace = || json_request(Method::POST, "/workspace", small(50));
    ask(0, workspace()).await.assert_problem(403, "forbidden");
    keys.get(&service, 0, "/workspace?tolerance=50").await.assert_problem(403, "forbidden");
    let dexterity = json_request(Method::POST, "/workspace/dexterity", json!({"tool_length": 50}));
    ask(0, dexterity).await.assert_problem(403, "forbidden");
    let errors = json_request(Method::POST, "/workspace/error-budget", json!({"cell": 50}));
    ask(0, errors).await.assert_problem(403, "forbidden");
    let made = ask(1, workspace()).await;
    assert_eq!(made.status, StatusCode::OK, "{}", made.json);
    let id = made.json["id"].as_str().unwrap();
    keys.delete(&service, 0, &format!("/jobs/{id}")).await.assert_problem(403, "forbidden");
    for part in ["", "/mesh?format=stl", "/slice?z=900"] {
        let uri = format!("/workspace/{id}{part}");
        let read = keys.get(&service, 0, &uri).await;
        assert_eq!(read.status, StatusCode::OK, "{uri}: {}", read.json);
    }
}

#[tokio::test]
async fn answers_to_a_key_are_private() {
    let keys = Keys::new([("cam", "read")]);
    let service = opened(&keys.asked_for_by(config(None))).await;
    let reply = keys.get(&service, 0, "/fk?rho=674,685,250").await;
    assert_eq!(reply.headers[CACHE_CONTROL], "private, max-age=300");
    assert_eq!(get("/fk?rho=674,685,250").await.headers[CACHE_CONTROL], "public, max-age=300");
}

#[tokio::test]
async fn a_key_sees_only_its_own_jobs() {
    let keys = Keys::new([("cam", "compute"), ("cad", "compute"), ("chief", "admin")]);
    let service = opened(&keys.asked_for_by(one_core())).await;
    let id = keys.start(&service, 0, &long(0)).await;
    let uri = format!("/jobs/{id}");
    for (number, count) in [(0, 1), (1, 0), (2, 1)] {
        let jobs = keys.get(&service, number, "/jobs").await.json;
        assert_eq!(jobs["jobs"].as_array().unwrap().len(), count, "key {number}");
    }
    for unseen in [uri.clone(), format!("{uri}/events")] {
        keys.get(&service, 1, &unseen).await.assert_problem(404, "job_not_found");
    }
    keys.delete(&service, 1, &uri).await.assert_problem(404, "job_not_found");
    assert_eq!(keys.get(&service, 0, &uri).await.status, StatusCode::OK);
    assert_eq!(keys.delete(&service, 2, &uri).await.status, StatusCode::OK);
    let last = keys.get(&service, 0, &format!("{uri}/events")).await;
    assert!(String::from_utf8(last.bytes).unwrap().contains("\"state\":\"cancelled\""));
}

#[tokio::test]
async fn every_key_that_requested_a_job_sees_it() {
    let keys = Keys::new([("cam", "compute"), ("cad", "compute"), ("chief", "admin")]);
    let service = opened(&keys.asked_for_by(one_core())).await;
    let id = keys.start(&service, 0, &long(0)).await;
    let uri = format!("/jobs/{id}");
    assert_eq!(keys.start(&service, 1, &long(0)).await, id);
    for number in [0, 1] {
        assert_eq!(keys.get(&service, number, &uri).await.status, StatusCode::OK);
        assert_eq!(keys.get(&service, number, "/jobs").await.json["jobs"][0]["id"], id);
    }
    let left = keys.delete(&service, 0, &uri).await;
    assert_eq!(left.status, StatusCode::OK);
    assert_ne!(left.json["state"], "cancelled");
    keys.get(&service, 0, &uri).await.assert_problem(404, "job_not_found");
    assert_ne!(keys.get(&service, 1, &uri).await.json["state"], "cancelled");
    keys.delete(&service, 1, &uri).await;
    let last = keys.get(&service, 1, &format!("{uri}/events")).await;
    assert!(String::from_utf8(last.bytes).unwrap().contains("\"state\":\"cancelled\""));
    // An administrator's word holds for all.
    for number in [0, 1] {
        keys.start(&service, number, &long(0)).await;
    }
    keys.delete(&service, 2, &uri).await;
    let last = keys.get(&service, 0, &format!("{uri}/events")).await;
    assert!(String::from_utf8(last.bytes).unwrap().contains("\"state\":\"cancelled\""));
}

#[tokio::test]
async fn a_read_key_does_not_recompute_an_evicted_result() {
    // No room for a mesh: only the figures stay.
    let keys = Keys::new([("reader", "read"), ("cam", "compute")]);
    let config = keys.asked_for_by(ServeConfig { cache_bytes: 20_000, ..config(None) });
    let service = opened(&config).await;
    let question = json_request(Method::POST, "/workspace", json!({"tolerance": 5}));
    let made = send_to(service.clone(), keys.sent(1, question)).await;
    let uri = format!("/workspace/{}/mesh", made.json["id"].as_str().unwrap());
    keys.get(&service, 0, &uri).await.assert_problem(403, "forbidden");
    keys.get(&service, 1, &uri).await.assert_problem(507, "no_room");
}

#[tokio::test]
async fn a_changed_key_file_is_read_again() {
    let keys = Keys::new([("cam", "read")]);
    let service = Service::open(&keys.asked_for_by(config(None))).await.unwrap();
    let status = async || keys.get(&service.router, 0, "/machines").await.status;
    keys.write("[[key]]\nname = 1");
    assert!(service.reload_keys().await.is_err());
    assert_eq!(status().await, StatusCode::OK, "what cannot be read changes nothing");
    keys.write(&fresh("other", "read").1);
    service.reload_keys().await.unwrap();
    assert_eq!(status().await, StatusCode::UNAUTHORIZED);
}

#[tokio::test]
async fn events_end_when_their_key_is_removed() {
    let keys = Keys::new([("cam", "compute"), ("cad", "admin")]);
    let service = Service::open(&keys.asked_for_by(one_core())).await.unwrap();
    let id = keys.start(&service.router, 0, &long(0)).await;
    let mut streams = Vec::new();
    for number in [0, 1] {
        let events = Request::get(format!("/jobs/{id}/events")).body(Body::empty()).unwrap();
        let answer = service.router.clone().oneshot(keys.sent(number, events)).await.unwrap();
        assert_eq!(answer.status(), StatusCode::OK);
        streams.push(answer.into_body());
    }
    let text = std::fs::read_to_string(keys.file()).unwrap();
    let (removed, kept) = text.split_once("\n\n").unwrap();
    keys.write(kept);
    service.reload_keys().await.unwrap();
    let [gone, stays] = streams.try_into().unwrap();
    // It would go on for minutes.
    let told =
        tokio::time::timeout(Duration::from_secs(30), gone.collect()).await.unwrap().unwrap().to_bytes();
    assert!(!String::from_utf8_lossy(&told).contains("succeeded"));
    keys.write(&format!("{removed}\n\n{kept}"));
    service.reload_keys().await.unwrap();
    keys.delete(&service.router, 1, &format!("/jobs/{id}")).await;
    let last = stays.collect().await.unwrap().to_bytes();
    assert!(String::from_utf8_lossy(&last).contains("\"state\":\"cancelled\""));
}

#[tokio::test]
async fn events_end_when_the_role_of_their_key_changes() {
    let keys = Keys::new([("cam", "compute")]);
    let service = Service::open(&keys.asked_for_by(one_core())).await.unwrap();
    let id = keys.start(&service.router, 0, &long(0)).await;
    let events = Request::get(format!("/jobs/{id}/events")).body(Body::empty()).unwrap();
    let answer = service.router.clone().oneshot(keys.sent(0, events)).await.unwrap();
    let text = std::fs::read_to_string(keys.file()).unwrap();
    keys.write(&text.replace("compute", "read"));
    service.reload_keys().await.unwrap();
    let ended = tokio::time::timeout(Duration::from_secs(30), answer.into_body().collect()).await;
    assert!(ended.is_ok());
}
