//! Leaves one media type for each body in the OpenAPI document.
//!
//! The service also speaks the others; Accept, Content-Type and `format` select them. A generated client would have to
//! choose among them at each call, and most generators cannot make it do so.

use serde_json::{Map, Value};

use crate::http::openapi::operations::{content, operations};

/// The preferred media types. A document with another one has that.
const PREFERRED: [&str; 3] = ["application/json", "application/octet-stream", "text/plain"];

/// Leaves one media type for each body, and no parameters that concern the others only.
pub(crate) fn keep_one_media_type(document: &mut Value) {
    for operation in operations(document) {
        let body = operation.get_mut("requestBody");
        // All fields of a request in JSON are in its body.
        let is_json = body.and_then(content).is_some_and(|content| {
            keep_one(content);
            content.contains_key("application/json")
        });
        let responses = operation.get_mut("responses").and_then(Value::as_object_mut);
        let mut is_narrower = false;
        for (_, response) in responses.into_iter().flatten().filter(|(status, _)| status.starts_with('2')) {
            is_narrower |= content(response).is_some_and(keep_one);
        }
        if let Some(parameters) = operation.get_mut("parameters").and_then(Value::as_array_mut) {
            parameters.retain(|parameter| {
                parameter["in"] != "query" || !(is_json || is_narrower && parameter["name"] == "format")
            });
        }
    }
}

/// Leaves the preferred media type. Whether there were others.
fn keep_one(content: &mut Map<String, Value>) -> bool {
    let preferred = PREFERRED.into_iter().find(|media| content.contains_key(*media));
    let Some(preferred) = preferred.filter(|_| content.len() > 1) else { return false };
    content.retain(|media, _| media == preferred);
    true
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::keep_one_media_type;

    #[test]
    fn each_body_keeps_one_media_type_and_its_parameters() {
        let [id, format, phi] = [("path", "id"), ("query", "format"), ("query", "phi1")]
            .map(|(place, name)| json!({"in": place, "name": name}));
        let mut document = json!({"paths": {
            "/a": {
                "get": {
                    "parameters": [id, format, phi],
                    "responses": {"200": {"content": {"application/json": 1, "text/csv": 2}}},
                },
                "post": {
                    "parameters": [id, format, phi],
                    "requestBody": {"content": {"application/json": 1, "text/csv": 2}},
                    "responses": {"200": {"content": {"application/json": 1}}},
                },
            },
            "/b": {"post": {
                "parameters": [format],
                "requestBody": {"content": {"text/csv": 1, "application/octet-stream": 2, "text/plain": 3}},
                "responses": {"200": {"content": {"model/stl": 1}}, "204": {}},
            }},
        }});
        keep_one_media_type(&mut document);
        let json = json!({"content": {"application/json": 1}});
        let expected = json!({"paths": {
            "/a": {
                "get": {"parameters": [id, phi], "responses": {"200": json}},
                "post": {"parameters": [id], "requestBody": json, "responses": {"200": json}},
            },
            "/b": {"post": {
                "parameters": [format],
                "requestBody": {"content": {"application/octet-stream": 2}},
                "responses": {"200": {"content": {"model/stl": 1}}, "204": {}},
            }},
        }});
        assert_eq!(document, expected);
    }
}
