//! The OpenAPI document in version 3.0.3, for generators that do not read 3.1.
//!
//! A generator for 3.0 makes one type of the successful answers of an operation. This version therefore joins them: the
//! result and the job that computes it are one schema. It leaves out a job beside a file, and an answer without a body
//! beside one with a body; their statuses are in the description. Some generators send only JSON, text and bytes: a
//! table is bytes, whose format the path states.

mod schema;

use serde_json::{Map, Value, json};
use verne_rows::Format;

use crate::http::openapi::operations::{components, content, drop_unused, operations};
use crate::http::openapi::version_3_0::schema::converted;

/// The media type of bytes.
const BYTES: &str = "application/octet-stream";

/// The document in version 3.0.3.
pub(crate) fn to_3_0(mut document: Value) -> Value {
    document["openapi"] = json!("3.0.3");
    if let Some(license) = document["info"].get_mut("license").and_then(Value::as_object_mut) {
        // 3.0 does not have the expression of SPDX.
        license.remove("identifier");
        license.insert("url".to_owned(), json!("https://spdx.org/licenses/"));
    }
    let mut named = components(&mut document, "schemas").map(std::mem::take).unwrap_or_default();
    for operation in operations(&mut document) {
        join_answers(operation, &mut named);
        if let Some(body) = operation.get_mut("requestBody").and_then(content) {
            state_bytes(body);
        }
    }
    convert_schemas(&mut document);
    if let Some(schemas) = components(&mut document, "schemas") {
        *schemas = named.into_iter().map(|(name, schema)| (name, converted(schema))).collect();
    }
    // The alternatives of an answer have become those of the answer or its job.
    drop_unused(&mut document, "schemas");
    document
}

/// Converts the schemas of parameters, bodies and headers.
fn convert_schemas(value: &mut Value) {
    match value {
        Value::Object(members) => {
            for (name, member) in members {
                match name.as_str() {
                    "schema" => *member = converted(member.take()),
                    "example" | "examples" => {}
                    _ => convert_schemas(member),
                }
            }
        }
        Value::Array(items) => items.iter_mut().for_each(convert_schemas),
        _ => {}
    }
}

/// States the bytes of a table instead of its media type.
fn state_bytes(body: &mut Map<String, Value>) {
    for table in Format::ALL {
        if body.remove(table.media()).is_some() {
            body.insert(BYTES.to_owned(), json!({"schema": {"type": "string", "format": "binary"}}));
        }
    }
}

/// Leaves one type of successful answers.
fn join_answers(operation: &mut Map<String, Value>, named: &mut Map<String, Value>) {
    let Some(responses) = operation.get_mut("responses").and_then(Value::as_object_mut) else { return };
    let statuses: Vec<String> = responses.keys().filter(|status| status.starts_with('2')).cloned().collect();
    let [first, others @ ..] = statuses.as_slice() else { return };
    for other in others {
        let [Some(a), Some(b)] = [first, other].map(|status| json_schema(responses, status).cloned()) else {
            let left = responses.remove(other);
            let description = left.as_ref().and_then(|left| left["description"].as_str());
            note(&mut responses[first.as_str()], other, description.unwrap_or_default());
            continue;
        };
        if a == b {
            continue;
        }
        if let (Some(name), Some(other_name)) = (name_of(&a), name_of(&b)) {
            let name = format!("{name}Or{other_name}");
            for status in [first, other] {
                if let Some(schema) = json_schema(responses, status) {
                    *schema = json!({"$ref": format!("#/components/schemas/{name}")});
                }
            }
            let mut alternatives = alternatives(&a, named);
            alternatives.push(b);
            named.insert(name, json!({"oneOf": alternatives}));
        }
    }
}

/// The alternatives of a schema, or the schema.
fn alternatives(schema: &Value, named: &Map<String, Value>) -> Vec<Value> {
    let target = name_of(schema).and_then(|name| named.get(name));
    let alternatives = target.and_then(|target| target["oneOf"].as_array());
    alternatives.cloned().unwrap_or_else(|| vec![schema.clone()])
}

fn json_schema<'a>(responses: &'a mut Map<String, Value>, status: &str) -> Option<&'a mut Value> {
    content(responses.get_mut(status)?)?.get_mut("application/json")?.get_mut("schema")
}

fn note(response: &mut Value, status: &str, description: &str) {
    let own = response["description"].as_str().unwrap_or_default();
    response["description"] = json!(format!("{own} Status {status}: {description}").trim());
}

/// The name of the component that a schema refers to.
fn name_of(schema: &Value) -> Option<&str> {
    schema["$ref"].as_str()?.rsplit('/').next()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use serde_json::{Value, json};

    use super::to_3_0;

    fn answer(name: &str) -> Value {
        json!({"description": name,
               "content": {"application/json": {"schema": {"$ref": format!("#/components/schemas/{name}")}}}})
    }

    #[test]
    fn the_body_of_a_table_is_bytes() {
        let document = to_3_0(json!({
            "info": {"license": {"name": "MIT"}},
            "paths": {"/rows.csv": {"post": {"requestBody": {"content": {"text/csv": {"example": "x,y"}}}}}},
        }));
        let bytes = json!({"schema": {"type": "string", "format": "binary"}});
        let content = &document["paths"]["/rows.csv"]["post"]["requestBody"]["content"];
        assert_eq!(*content, json!({"application/octet-stream": bytes}));
    }

    #[test]
    fn a_result_and_its_job_become_one_schema() {
        let file =
            json!({"description": "A file.", "content": {"model/stl": {"schema": {"type": "string"}}}});
        let document = to_3_0(json!({
            "openapi": "3.1.0",
            "info": {"license": {"name": "MIT", "identifier": "MIT"}},
            "components": {"schemas": {"A": {"type": "object"}, "Job": {"type": ["string", "null"]}, "B": {}}},
            "paths": {
                "/a": {"get": {"responses": {"200": answer("A"), "202": answer("Job"), "404": answer("P")}}},
                "/b": {"post": {"responses": {"200": answer("A"), "201": answer("A")}}},
                "/c": {"get": {"responses": {"200": file, "202": answer("Job")}}},
            },
        }));
        assert_eq!(document["openapi"], "3.0.3");
        assert_eq!(document["info"]["license"], json!({"name": "MIT", "url": "https://spdx.org/licenses/"}));
        let of = |path: &str, method: &str| document["paths"][path][method]["responses"].clone();
        let schema = |answer: &Value| answer["content"]["application/json"]["schema"]["$ref"].clone();
        let a = of("/a", "get");
        assert_eq!((schema(&a["200"]), schema(&a["202"])), (schema(&answer("AOrJob")), schema(&a["200"])));
        assert_eq!(a["404"], answer("P"));
        assert_eq!(of("/b", "post")["201"], answer("A"));
        let c = of("/c", "get");
        assert_eq!(c.as_object().unwrap().len(), 1);
        assert_eq!(c["200"]["description"], "A file. Status 202: Job");
        let schemas = &document["components"]["schemas"];
        assert_eq!(schemas["Job"], json!({"type": "string", "nullable": true}));
        assert_eq!(schemas.get("B"), None);
        let both = ["A", "Job"].map(|name| json!({"$ref": format!("#/components/schemas/{name}")}));
        assert_eq!(schemas["AOrJob"], json!({"oneOf": both}));
    }

    #[test]
    fn examples_stay_as_they_are() {
        let media = json!({"schema": {"const": 1}, "example": {"schema": {"const": 1}}});
        let document =
            to_3_0(json!({"info": {}, "paths": {"/a": {"post": {"requestBody": {"content": media}}}}}));
        let media = &document["paths"]["/a"]["post"]["requestBody"]["content"];
        assert_eq!(*media, json!({"schema": {"enum": [1]}, "example": {"schema": {"const": 1}}}));
    }
}
