//! Leaves bare references in lists of schemas.
//!
//! Some generators make a type without a name of a reference that has a description beside it, and then lose the type.

use serde_json::{Map, Value, json};

/// Removes the description beside each reference in a list of schemas. If the only other schema is null, it becomes the
/// description of the list.
pub(crate) fn bare_references(value: &mut Value) {
    match value {
        Value::Array(items) => items.iter_mut().for_each(bare_references),
        Value::Object(members) => {
            members.values_mut().for_each(bare_references);
            for keyword in ["allOf", "anyOf", "oneOf"] {
                make_bare(members, keyword);
            }
        }
        _ => {}
    }
}

fn make_bare(schema: &mut Map<String, Value>, keyword: &str) {
    let Some(Value::Array(schemas)) = schema.get_mut(keyword) else { return };
    let is_optional = schemas.len() == 2 && schemas.contains(&json!({"type": "null"}));
    let mut description = None;
    for schema in schemas.iter_mut().filter_map(Value::as_object_mut) {
        if schema.contains_key("$ref") {
            description = schema.remove("description").or(description);
        }
    }
    if let Some(description) = description.filter(|_| is_optional) {
        schema.entry("description").or_insert(description);
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::bare_references;

    #[test]
    fn references_lose_or_pass_on_their_descriptions() {
        let (a, b, none) = (json!({"$ref": "a"}), json!({"$ref": "b"}), json!({"type": "null"}));
        let about = json!({"$ref": "a", "description": "A."});
        let mut document = json!({
            "one": {"oneOf": [about, b]},
            "two": [{"oneOf": [none, about]}],
            "three": {"anyOf": [about, none], "description": "Three."},
            "four": about,
            "five": {"oneOf": [{"type": "string", "description": "B."}, b]},
            "six": {"allOf": [about, {"type": "object"}]},
        });
        bare_references(&mut document);
        let expected = json!({
            "one": {"oneOf": [a, b]},
            "two": [{"oneOf": [none, a], "description": "A."}],
            "three": {"anyOf": [a, none], "description": "Three."},
            "four": about,
            "five": {"oneOf": [{"type": "string", "description": "B."}, b]},
            "six": {"allOf": [a, {"type": "object"}]},
        });
        assert_eq!(document, expected);
    }
}
