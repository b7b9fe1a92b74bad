//! The machine object's JSON Schema, on its own.

use serde_json::{Value, json};
use utoipa::PartialSchema;

use crate::http::openapi::inlined::join_descriptions;
use crate::wire::machine::MachineObject;

/// The schema that the OpenAPI document holds, as a JSON Schema document.
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
