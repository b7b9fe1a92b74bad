//! Every failure that a test provokes is documented for its operation.

use std::sync::LazyLock;

use axum::http::Method;
use axum::http::header::CONTENT_TYPE;
use serde_json::Value;

use super::Reply;

static DOCUMENT: LazyLock<Value> =
    LazyLock::new(|| serde_json::from_str(include_str!("../../../openapi/openapi.json")).unwrap());

/// Asserts that the operation of this method and path documents the reply, if it is a failure.
pub(super) fn assert_documented(method: &Method, path: &str, reply: &Reply) {
    let media = reply.headers.get(CONTENT_TYPE).and_then(|media| media.to_str().ok());
    let (Some("application/problem+json"), Some(item)) = (media, item(path)) else { return };
    // A failure of HEAD has no body.
    let (method, Some(code)) = (method.as_str().to_ascii_lowercase(), reply.json["code"].as_str()) else {
        return;
    };
    let Some(operation) = item.get(&method) else { return };
    let documented = &operation["responses"][reply.status.as_str()]["content"]["application/problem+json"];
    let reference = documented["examples"][code]["$ref"].as_str();
    let reference = reference.unwrap_or_else(|| panic!("{method} {path}: {code} is not documented"));
    let example = DOCUMENT.pointer(reference.strip_prefix('#').unwrap()).unwrap();
    for field in ["type", "title", "status", "code"] {
        assert_eq!(example["value"][field], reply.json[field], "{method} {path}");
    }
}

/// The document's entry for a path. Of a file, the document lists the paths of its formats only.
fn item(path: &str) -> Option<&'static Value> {
    listed(path).or_else(|| listed(&format!("{path}.json")))
}

/// The entry that fits a path: the literal one before one with parameters.
fn listed(path: &str) -> Option<&'static Value> {
    let paths = DOCUMENT["paths"].as_object().unwrap();
    let fits = |template: &str| {
        let (mut parts, mut wanted) = (path.split('/'), template.split('/'));
        loop {
            match (parts.next(), wanted.next()) {
                (None, None) => return true,
                (Some(part), Some(wanted)) if part == wanted || wanted.starts_with('{') => {}
                _ => return false,
            }
        }
    };
    paths.get(path).or_else(|| paths.iter().find(|(template, _)| fits(template)).map(|(_, item)| item))
}
