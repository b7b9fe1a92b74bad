//! Mends inlined schemas.

use serde_json::Value;

/// The generator writes an inlined schema with a description as two schemas that must both hold, the
/// second of type object: no array fits such a pair. Here they become one schema again.
pub(crate) fn join_descriptions(value: &mut Value) {
    if let Some(joined) = joined(value) {
        *value = joined;
    }
    match value {
        Value::Array(items) => items.iter_mut().for_each(join_descriptions),
        Value::Object(members) => members.values_mut().for_each(join_descriptions),
        _ => {}
    }
}

fn joined(value: &Value) -> Option<Value> {
    let [schema, note] = value.get("allOf")?.as_array()?.as_slice() else { return None };
    let description = note.get("description")?;
    let only_a_note =
        note.as_object()?.keys().all(|key| ["type", "description", "example"].contains(&key.as_str()));
    if !only_a_note || schema.get("type").is_none() {
        return None;
    }
    let mut joined = schema.clone();
    joined["description"] = description.clone();
    if let Some(example) = note.get("example") {
        joined["example"] = example.clone();
    }
    Some(joined)
}
