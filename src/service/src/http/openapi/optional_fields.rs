//! States the defaults of optional fields in words.
//!
//! Some generators take a field with a `default` as one that is always there: a client that sends the object then has
//! to state it.

use serde_json::{Map, Value};

use crate::http::openapi::operations::components;

/// Moves the default of each optional field of a schema into its description.
pub(crate) fn describe_defaults(document: &mut Value) {
    for schema in components(document, "schemas").into_iter().flat_map(|schemas| schemas.values_mut()) {
        describe_in(schema);
    }
}

fn describe_in(schema: &mut Value) {
    match schema {
        Value::Object(schema) => {
            if let Some(fields) = schema.get_mut("properties").and_then(Value::as_object_mut) {
                fields.values_mut().filter_map(Value::as_object_mut).for_each(describe);
            }
            schema.values_mut().for_each(describe_in);
        }
        Value::Array(schemas) => schemas.iter_mut().for_each(describe_in),
        _ => {}
    }
}

fn describe(field: &mut Map<String, Value>) {
    let Some(default) = field.remove("default") else { return };
    let default = default.as_str().map_or_else(|| default.to_string(), str::to_owned);
    let default = format!("The default is {}.", default.strip_suffix(".0").unwrap_or(&default));
    let description = match field.get("description").and_then(Value::as_str) {
        Some(description) => format!("{description} {default}"),
        None => default,
    };
    field.insert("description".to_owned(), description.into());
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::describe_defaults;

    #[test]
    fn defaults_of_fields_become_words() {
        let mut document = json!({"components": {"schemas": {
            "Name": {"type": "string", "default": "verne"},
            "Request": {"allOf": [{"properties": {
                "length": {"type": "number", "default": 0.0, "description": "Length, mm."},
                "is_open": {"type": "boolean", "default": false},
                // A field of this name.
                "default": {"type": "number"},
            }}]},
        }}});
        describe_defaults(&mut document);
        let expected = json!({"components": {"schemas": {
            "Name": {"type": "string", "default": "verne"},
            "Request": {"allOf": [{"properties": {
                "length": {"type": "number", "description": "Length, mm. The default is 0."},
                "is_open": {"type": "boolean", "description": "The default is false."},
                "default": {"type": "number"},
            }}]},
        }}});
        assert_eq!(document, expected);
    }
}
