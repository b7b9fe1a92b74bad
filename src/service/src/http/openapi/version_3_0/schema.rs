//! Schemas of OpenAPI 3.1, which are JSON Schema, as schemas of 3.0.

use std::collections::HashSet;

use serde_json::{Map, Value, json};

/// Keywords that 3.0 does not have and that have no counterpart.
const DROPPED: [&str; 4] = ["$schema", "contentEncoding", "contentMediaType", "propertyNames"];

/// The components to which references lead.
pub(super) struct Schemas<'a>(pub &'a Map<String, Value>);

impl Schemas<'_> {
    /// The schema in version 3.0.
    pub(super) fn converted(&self, schema: Value) -> Value {
        match schema {
            Value::Object(schema) => Value::Object(self.object(schema)),
            // `true` allows everything.
            _ => json!({}),
        }
    }

    fn object(&self, mut schema: Map<String, Value>) -> Map<String, Value> {
        for keyword in DROPPED {
            schema.remove(keyword);
        }
        self.convert_members(&mut schema);
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
        // No other member may stand beside a reference.
        if schema.len() > 1
            && let Some(target) = schema.remove("$ref")
        {
            schema.insert("allOf".to_owned(), json!([{"$ref": target}]));
        }
        self.without_null(schema)
    }

    /// Converts the schemas within a schema.
    fn convert_members(&self, schema: &mut Map<String, Value>) {
        for (name, member) in schema {
            match (name.as_str(), member) {
                ("items" | "additionalProperties" | "not", member) if member.is_object() => {
                    *member = self.converted(member.take());
                }
                ("properties", Value::Object(fields)) => {
                    fields.values_mut().for_each(|field| *field = self.converted(field.take()));
                }
                ("allOf" | "anyOf" | "oneOf", Value::Array(alternatives)) => {
                    for alternative in alternatives.iter_mut().filter(|alternative| !is_null(alternative)) {
                        *alternative = self.converted(alternative.take());
                    }
                }
                _ => {}
            }
        }
    }

    /// The schema with `nullable` in place of the type `null`.
    fn without_null(&self, mut schema: Map<String, Value>) -> Map<String, Value> {
        if let Some(Value::Array(types)) = schema.get_mut("type") {
            types.retain(|kind| kind != "null");
            if let [kind] = types.as_slice() {
                let kind = kind.clone();
                schema.insert("type".to_owned(), kind);
                schema.insert("nullable".to_owned(), json!(true));
            }
        }
        for keyword in ["anyOf", "oneOf"] {
            let Some(Value::Array(alternatives)) = schema.get_mut(keyword) else { continue };
            let before = alternatives.len();
            alternatives.retain(|alternative| !is_null(alternative));
            if alternatives.len() == before {
                continue;
            }
            match alternatives.as_mut_slice() {
                [only] => {
                    let mut only = self.nullable(only.take());
                    schema.remove(keyword);
                    schema.append(&mut only);
                }
                [first, ..] => *first = Value::Object(self.nullable(first.take())),
                [] => {}
            }
        }
        schema
    }

    /// The converted schema, and null. `nullable` counts only beside a type.
    fn nullable(&self, schema: Value) -> Map<String, Value> {
        let Value::Object(mut schema) = schema else { return Map::new() };
        if let Some(target) = self.target(&schema) {
            match target.get("type").and_then(Value::as_str) {
                Some(kind) => {
                    schema.insert("type".to_owned(), json!(kind));
                    if let Some(reference) = schema.remove("$ref") {
                        schema.insert("allOf".to_owned(), json!([{"$ref": reference}]));
                    }
                }
                None => schema = self.object(target.clone()),
            }
        }
        if schema.contains_key("type") {
            schema.insert("nullable".to_owned(), json!(true));
        } else if let Some(Value::Array(alternatives)) = ["anyOf", "oneOf"]
            .into_iter()
            .find(|keyword| schema.contains_key(*keyword))
            .and_then(|keyword| schema.get_mut(keyword))
            && let Some(first) = alternatives.first_mut()
        {
            *first = Value::Object(self.nullable(first.take()));
        }
        schema
    }

    /// The component to which a reference leads, with or without members beside it.
    fn target(&self, schema: &Map<String, Value>) -> Option<&Map<String, Value>> {
        let reference = match schema.get("allOf") {
            Some(Value::Array(only)) if only.len() == 1 => only[0].get("$ref"),
            _ => schema.get("$ref"),
        };
        self.0.get(reference?.as_str()?.rsplit('/').next()?)?.as_object()
    }
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
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use serde_json::{Value, json};

    use super::Schemas;

    #[test]
    fn each_keyword_has_its_counterpart() {
        let components = json!({
            "Name": {"type": "string", "enum": ["a", "b"]},
            "Either": {"oneOf": [{"$ref": "#/components/schemas/Name"}, {"type": "number"}]},
        });
        let schemas = Schemas(components.as_object().unwrap());
        let name = json!({"$ref": "#/components/schemas/Name"});
        let nullable_name = json!({"type": "string", "nullable": true, "allOf": [name]});
        let null = json!({"type": "null"});
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
            (json!({"oneOf": [name, null]}), nullable_name.clone()),
            (
                json!({"oneOf": [name, null], "description": "A name."}),
                json!({"type": "string", "nullable": true, "allOf": [name], "description": "A name."}),
            ),
            (
                json!({"oneOf": [{"type": "number"}, {"type": "string"}, null]}),
                json!({"oneOf": [{"type": "number", "nullable": true}, {"type": "string"}]}),
            ),
            (
                json!({"oneOf": [{"$ref": "#/components/schemas/Either"}, null], "description": "One."}),
                json!({"oneOf": [nullable_name, {"type": "number"}], "description": "One."}),
            ),
        ] {
            assert_eq!(schemas.converted(schema.clone()), expected, "{schema}");
        }
        assert_eq!(schemas.converted(Value::Bool(true)), json!({}));
    }
}
