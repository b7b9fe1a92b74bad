//! The JSON Schema of the machine object, and a correction of the generator's schemas.

use serde_json::{Value, json};
use utoipa::PartialSchema;

use crate::wire::machine::MachineObject;

/// The machine object of the OpenAPI document as a JSON Schema document.
pub(crate) fn machine_schema() -> Value {
    let mut document = json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Machine of the VERNE architecture",
    });
    if let (Some(document), Value::Object(schema)) =
        (document.as_object_mut(), json!(MachineObject::schema()))
    {
        document.extend(schema);
    }
    join_descriptions(&mut document);
    document
}

/// Joins each inlined schema with its description.
///
/// The generator writes such a schema as `allOf` of the schema and of an object with the description. No array is valid
/// against both.
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
    let (description, note) = (note.get("description")?, note.as_object()?);
    let is_note = note.keys().all(|key| ["type", "description", "example"].contains(&key.as_str()));
    if !is_note || schema.get("type").is_none() {
        return None;
    }
    let mut joined = schema.clone();
    joined["description"] = description.clone();
    if let Some(example) = note.get("example") {
        joined["example"] = example.clone();
    }
    Some(joined)
}
