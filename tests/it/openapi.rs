//! The OpenAPI document: the committed one is the generated one, and its examples are true.

use std::collections::HashSet;

use axum::Router;
use axum::body::Body;
use axum::http::header::CONTENT_TYPE;
use axum::http::{Method, Request};
use serde_json::{Value, json};

use crate::http::{Reply, get, json_request, send_to, service};

#[tokio::test]
async fn the_committed_document_equals_the_generated_one() {
    let committed = get("/openapi.json").await.json;
    let generated = verne_service::document();
    let difference = difference("", &with_numbered_ids(&generated), &with_numbered_ids(&committed));
    assert_eq!(
        difference, None,
        "openapi/openapi.json is stale; renew it: cargo run --release -- openapi > openapi/openapi.json"
    );
}

#[test]
fn the_api_guide_lists_every_problem_code_as_the_service_does() {
    let document = verne_service::document();
    let description = document["info"]["description"].as_str().unwrap();
    let generated: Vec<_> = description.lines().filter(|line| line.starts_with('|')).collect();
    let guide = include_str!("../../docs/api.md");
    let after_begin = guide.split_once("<!-- codes: begin -->\n").unwrap().1;
    let committed: Vec<_> = after_begin.split_once("<!-- codes: end -->").unwrap().0.lines().collect();
    assert_eq!(
        committed, generated,
        "the table of codes in docs/api.md is stale; its last section says how to renew it"
    );
}

#[tokio::test]
async fn every_example_has_its_documented_answer() {
    // The committed document has the ids of another build.
    let document = verne_service::document();
    // One service for all: results are asked for after /workspace has computed them.
    let service = service().await;
    let mut sent = 0;
    let mut paths: Vec<_> = document["paths"].as_object().unwrap().iter().collect();
    // A workspace is a job before it is a result.
    paths.sort_by_key(|(path, _)| path.starts_with("/jobs"));
    for (path, operations) in paths {
        for (method, operation) in operations.as_object().unwrap() {
            assert!(
                operation["summary"].is_string() && operation["description"].is_string(),
                "{method} {path}"
            );
            // A map has points, and the example is no map; streams of Arrow are no texts.
            let is_shown = operation.get("requestBody").is_none_or(|body| example_of_body(body).is_some());
            if path == "/openapi.json" || path.starts_with("/workspace/{id}/cells") || !is_shown {
                continue;
            }
            let reply = send_example(&service, path, method, operation).await;
            assert!(reply.status.is_success(), "{method} {path}: {}", reply.json);
            let content = &operation["responses"][reply.status.as_str()]["content"];
            let media = reply.headers[CONTENT_TYPE].to_str().unwrap().split(';').next().unwrap();
            assert!(content.get(media).is_some(), "{method} {path}: {media} is not documented");
            // A job says when it was made.
            if let Some(documented) = content[media].get("example").filter(|_| media == "application/json") {
                assert_eq!(difference("", &reply.json, documented), None, "{method} {path}");
            }
            sent += 1;
        }
    }
    assert_eq!(sent, 63);
}

async fn send_example(service: &Router, path: &str, method: &str, operation: &Value) -> Reply {
    let (media, body) = example_of_body(&operation["requestBody"]).unzip();
    if let Some(body) = body.filter(|body| !body.is_string()) {
        return send_to(service.clone(), json_request(Method::POST, path, body)).await;
    }
    let mut uri = path.to_owned();
    let mut separator = '?';
    for parameter in operation["parameters"].as_array().into_iter().flatten() {
        let Some(example) = parameter.get("example") else { continue };
        let name = parameter["name"].as_str().unwrap();
        let text = match example.as_str() {
            Some(text) => text.replace('"', "%22").replace('{', "%7B").replace('}', "%7D"),
            None => example.to_string().replace(['[', ']'], ""),
        };
        if parameter["in"] == "path" {
            uri = uri.replace(&format!("{{{name}}}"), &text);
        } else {
            uri = format!("{uri}{separator}{name}={text}");
            separator = '&';
        }
    }
    let method = Method::from_bytes(method.to_ascii_uppercase().as_bytes()).unwrap();
    let text = body.and_then(Value::as_str).unwrap_or_default().to_owned();
    let mut request = Request::builder().method(method).uri(uri);
    if let Some(media) = media {
        request = request.header(CONTENT_TYPE, media);
    }
    send_to(service.clone(), request.body(Body::from(text)).unwrap()).await
}

/// The media type of a body and its example, if the document has one.
fn example_of_body(body: &Value) -> Option<(&String, &Value)> {
    body["content"].as_object()?.iter().find_map(|(media, body)| Some((media, body.get("example")?)))
}

/// The document with the numbers 0, 1, ... in place of its ids, in their order: ids differ between targets.
fn with_numbered_ids(document: &Value) -> Value {
    let mut text = document.to_string();
    let is_word = |c: char| c.is_ascii_alphanumeric();
    let words = text.split(|c| !is_word(c));
    let ids = words.filter(|word| word.len() == 64 && word.chars().all(|c| c.is_ascii_hexdigit()));
    let mut seen = Vec::new();
    for id in ids {
        if !seen.contains(&id) {
            seen.push(id);
        }
    }
    let seen: Vec<_> = seen.into_iter().map(str::to_owned).collect();
    assert!(seen.len() > 3, "{seen:?}");
    for (number, id) in seen.iter().enumerate() {
        text = text.replace(id, &number.to_string());
    }
    serde_json::from_str(&text).unwrap()
}

/// The differences of two documents. Numbers may differ by rounding: sines differ between platforms.
fn difference(at: &str, a: &Value, b: &Value) -> Option<String> {
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => {
            let (a, b) = (a.as_f64().unwrap(), b.as_f64().unwrap());
            ((a - b).abs() > 1e-9 * a.abs().max(1.0)).then(|| format!("{at}: {a} and {b}"))
        }
        (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
            a.iter().zip(b).enumerate().find_map(|(i, (a, b))| difference(&format!("{at}/{i}"), a, b))
        }
        (Value::Object(a), Value::Object(b)) if a.keys().eq(b.keys()) => {
            a.iter().find_map(|(name, value)| difference(&format!("{at}/{name}"), value, &b[name]))
        }
        _ => (a != b).then(|| format!("{at}: {a} and {b}")),
    }
}

/// Generators name the parameters and the answer of an operation after it.
#[tokio::test]
async fn no_operation_is_named_like_a_schema() {
    let document = get("/openapi.json").await.json;
    let squeezed = |name: &str| name.replace('_', "").to_lowercase();
    let schemas = document["components"]["schemas"].as_object().unwrap().keys();
    let schemas: HashSet<_> = schemas.map(|name| squeezed(name)).collect();
    for operation in operations(&document) {
        let id = operation["operationId"].as_str().unwrap();
        for suffix in ["", "request", "response"] {
            assert!(!schemas.contains(&format!("{}{suffix}", squeezed(id))), "{id}{suffix}");
        }
    }
}

#[tokio::test]
async fn each_operation_has_one_media_type_and_says_whether_it_needs_a_key() {
    let document = get("/openapi.json").await.json;
    for operation in operations(&document) {
        let id = &operation["operationId"];
        let statuses = operation["responses"].as_object().unwrap().iter();
        let answers = statuses.filter(|(status, _)| status.starts_with('2')).map(|(_, answer)| answer);
        for body in answers.chain(operation.get("requestBody")) {
            let content = body["content"].as_object();
            assert!(content.is_none_or(|content| content.len() == 1), "{id}: {content:?}");
        }
        assert!(operation["security"].is_array(), "{id}");
    }
}

#[tokio::test]
async fn the_document_is_also_there_in_version_3_0() {
    let document = get("/openapi.json?v=3.0").await.json;
    assert_eq!(document["openapi"], "3.0.3");
    assert_eq!(get("/openapi.json?v=3.1").await.json["openapi"], "3.1.0");
    get("/openapi.json?v=2.0").await.assert_bad_field("/query/v");
}

fn operations(document: &Value) -> impl Iterator<Item = &Value> {
    document["paths"].as_object().unwrap().values().flat_map(|item| item.as_object().unwrap().values())
}

/// Two types of one name would be one schema, the last one's.
#[tokio::test]
async fn the_status_of_a_row_and_of_the_service_are_two_schemas() {
    let document = get("/openapi.json").await.json;
    let schemas = &document["components"]["schemas"];
    let of_health = schemas["Health"]["properties"]["status"]["$ref"].as_str().unwrap();
    let of_health = document.pointer(of_health.strip_prefix('#').unwrap()).unwrap();
    assert_eq!(of_health["enum"], json!(["ok", "degraded"]));
    assert_eq!(schemas["Status"]["enum"], json!(["ok", "unreachable", "infeasible", "invalid"]));
}

/// The codes that an operation documents.
fn codes(operation: &Value) -> Vec<&str> {
    let responses = operation["responses"].as_object().unwrap().values();
    let examples = responses
        .filter_map(|response| response["content"]["application/problem+json"]["examples"].as_object());
    examples.flat_map(|examples| examples.keys().map(String::as_str)).collect()
}

#[tokio::test]
async fn operations_that_wait_for_jobs_document_their_failures() {
    let document = get("/openapi.json").await.json;
    for operation in operations(&document) {
        let waits = operation["responses"].get("202").is_some();
        let codes = codes(operation);
        for code in
            ["queue_full", "disk_failing", "job_cancelled", "job_too_long", "other_version", "no_room"]
        {
            assert!(!waits || codes.contains(&code), "{}: {code}", operation["operationId"]);
        }
        for code in ["internal", "invalid_request", "not_acceptable", "timed_out"] {
            assert!(codes.contains(&code), "{}: {code}", operation["operationId"]);
        }
    }
    let has = |path: &str, method: &str, code| codes(&document["paths"][path][method]).contains(&code);
    assert!(has("/workspace", "post", "no_mesh") && !has("/workspace/dexterity", "post", "no_mesh"));
    assert!(
        has("/workspace/{id}/slice.svg", "get", "no_slice")
            && !has("/workspace/{id}/mesh.glb", "get", "no_slice")
    );
    assert!(has("/jobs", "get", "jobs_unavailable") && !has("/machines", "get", "jobs_unavailable"));
}
