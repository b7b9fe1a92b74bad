//! Schemas of OpenAPI 3.1, which are JSON Schema, as schemas of 3.0.

use std::collections::HashSet;

use serde_json::{Map, Value, json};

/// Keywords that 3.0 does not have and that have no counterpart.
const DROPPED: [&str; 4] = ["$schema", "contentEncoding", "contentMediaType", "propertyNames"];

/// The schema in version 3.0.
pub(super) fn converted(schema: Value) -> Value {
    match schema {
        Value::Object(schema) => Value::Object(object(schema)),
        // `true` allows everything.
        _ => json!({}),
    }
}

fn object(mut schema: Map<String, Value>) -> Map<String, Value> {
    for keyword in DROPPED {
        schema.remove(keyword);
    }
    convert_members(&mut schema);
    join_colliding_fields(&mut schema);
    if let Some(value) = schema.remove("const") {
        schema.insert("enum".to_owned(), json!([value]));
    }
    if let Some(Value::Array(examples)) = schema.remove("examples") {
        schema.extend(examples.into_iter().next().map(|example| ("example".to_owned(), example)));
    }
    for (bound, exclusive) in [("minimum", "exclusiveMinimum"), ("maximum", "exclusiveMaximum")] {
        if let Some(limit) = schema.remove(exclusive) {
            schema.insert(bound.to_owned(), limit);
            schema.insert(exclusive.to_owned(), json!(true));
        }
    }
    // In a list of types, null is one of two.
    if let Some(Value::Array(types)) = schema.get("type") {
        let kind = types.iter().find(|kind| *kind != "null").cloned();
        schema.extend(kind.map(|kind| ("type".to_owned(), kind)));
        schema.insert("nullable".to_owned(), json!(true));
    }
    schema = without_null(schema);
    // No other member may stand beside a reference.
    if schema.len() > 1
        && let Some(target) = schema.remove("$ref")
    {
        schema.insert("allOf".to_owned(), json!([{"$ref": target}]));
    }
    schema
}

/// Converts the schemas within a schema.
fn convert_members(schema: &mut Map<String, Value>) {
    for (name, member) in schema {
        match (name.as_str(), member) {
            ("items" | "additionalProperties" | "not", member) if member.is_object() => {
                *member = converted(member.take());
            }
            ("properties", Value::Object(fields)) => {
                fields.values_mut().for_each(|field| *field = converted(field.take()));
            }
            ("allOf" | "anyOf" | "oneOf", Value::Array(schemas)) => {
                for schema in schemas.iter_mut().filter(|schema| !is_null(schema)) {
                    *schema = converted(schema.take());
                }
            }
            _ => {}
        }
    }
}

/// The schema with `nullable` in place of the alternative null. An only other alternative takes the place of the list.
fn without_null(mut schema: Map<String, Value>) -> Map<String, Value> {
    for keyword in ["anyOf", "oneOf"] {
        let Some(Value::Array(alternatives)) = schema.get_mut(keyword) else { continue };
        let before = alternatives.len();
        alternatives.retain(|alternative| !is_null(alternative));
        if alternatives.len() == before {
            continue;
        }
        if let [Value::Object(only)] = alternatives.as_mut_slice() {
            let mut only = std::mem::take(only);
            schema.remove(keyword);
            only.append(&mut schema);
            schema = only;
        }
        schema.insert("nullable".to_owned(), json!(true));
    }
    schema
}

/// Makes a map of an object if the names of two fields differ only in case, such as `D1` and `d1`: generators write
/// names in the case of their language, and would make one field of both.
fn join_colliding_fields(schema: &mut Map<String, Value>) {
    let Some(fields) = schema.get("properties").and_then(Value::as_object) else { return };
    let lowercase: HashSet<String> = fields.keys().map(|name| name.to_lowercase()).collect();
    let Some(first) = fields.values().next().filter(|_| lowercase.len() < fields.len()) else { return };
    let about = |(name, field): (&String, &Value)| {
        format!("`{name}`: {}", field["description"].as_str().unwrap_or_default())
    };
    let fields_in_words = fields.iter().map(about).collect::<Vec<_>>().join(" ");
    let description = schema.get("description").and_then(Value::as_str).unwrap_or_default();
    let map = json!({
        "type": "object",
        "description": format!("{description} {fields_in_words}").trim(),
        "additionalProperties": {"type": first["type"], "format": first["format"]},
    });
    if let Value::Object(map) = map {
        *schema = map;
    }
}

fn is_null(schema: &Value) -> bool {
    schema.as_object().is_some_and(|members| members.len() == 1) && schema["type"] == "null"
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::converted;

    #[test]
    fn each_keyword_has_its_counterpart() {
        let name = json!({"$ref": "#/components/schemas/Name"});
        let none = json!({"type": "null"});
        for (schema, expected) in [
            (json!({"type": ["number", "null"]}), json!({"type": "number", "nullable": true})),
            (json!({"const": "verne"}), json!({"enum": ["verne"]})),
            (json!({"type": "string", "examples": ["x", "y"]}), json!({"type": "string", "example": "x"})),
            (json!({"exclusiveMinimum": 0}), json!({"minimum": 0, "exclusiveMinimum": true})),
            (json!({"contentMediaType": "application/json"}), json!({})),
            (json!({"additionalProperties": false}), json!({"additionalProperties": false})),
            (json!({"items": {"const": 1}}), json!({"items": {"enum": [1]}})),
            // Fields with the names of keywords.
            (json!({"properties": {"const": {"const": 1}}}), json!({"properties": {"const": {"enum": [1]}}})),
            (
                json!({"type": "object", "description": "Sizes.", "required": ["D"], "properties": {
                    "D": {"type": "number", "format": "double", "description": "Wide."},
                    "d": {"type": "number", "format": "double", "description": "Narrow."},
                }}),
                json!({"type": "object", "description": "Sizes. `D`: Wide. `d`: Narrow.",
                       "additionalProperties": {"type": "number", "format": "double"}}),
            ),
            (name.clone(), name.clone()),
            (
                json!({"$ref": "#/components/schemas/Name", "description": "A name."}),
                json!({"allOf": [name], "description": "A name."}),
            ),
            (json!({"oneOf": [name, none]}), json!({"nullable": true, "allOf": [name]})),
            (
                json!({"oneOf": [name, none], "description": "A name."}),
                json!({"nullable": true, "allOf": [name], "description": "A name."}),
            ),
            (
                json!({"anyOf": [none, {"const": 1}], "description": "One."}),
                json!({"enum": [1], "nullable": true, "description": "One."}),
            ),
            (
                json!({"oneOf": [{"type": "number"}, {"type": "string"}, none]}),
                json!({"oneOf": [{"type": "number"}, {"type": "string"}], "nullable": true}),
            ),
        ] {
            assert_eq!(converted(schema.clone()), expected, "{schema}");
        }
        assert_eq!(converted(Value::Bool(true)), json!({}));
    }
}
