//! Access to the parts of an OpenAPI document.

use std::collections::HashSet;

use serde_json::{Map, Value};

/// The operations of all paths.
pub(crate) fn operations(document: &mut Value) -> impl Iterator<Item = &mut Map<String, Value>> {
    let paths = document.get_mut("paths").and_then(Value::as_object_mut);
    let items = paths.into_iter().flat_map(|paths| paths.values_mut()).filter_map(Value::as_object_mut);
    items.flat_map(|item| item.values_mut()).filter_map(Value::as_object_mut)
}

/// The media types of a body, with what the document says about each.
pub(crate) fn content(body: &mut Value) -> Option<&mut Map<String, Value>> {
    body.get_mut("content").and_then(Value::as_object_mut)
}

/// The component of a kind, such as `schemas`.
pub(crate) fn components<'a>(document: &'a mut Value, kind: &str) -> Option<&'a mut Map<String, Value>> {
    document.get_mut("components")?.get_mut(kind)?.as_object_mut()
}

/// Drops the components of a kind to which nothing refers.
pub(crate) fn drop_unused(document: &mut Value, kind: &str) {
    let mut used = HashSet::new();
    collect_references(document, &mut used);
    if let Some(components) = components(document, kind) {
        components.retain(|name, _| used.contains(&format!("#/components/{kind}/{name}")));
    }
}

fn collect_references(value: &Value, references: &mut HashSet<String>) {
    match value {
        Value::Object(members) => {
            references.extend(members.get("$ref").and_then(Value::as_str).map(str::to_owned));
            members.values().for_each(|member| collect_references(member, references));
        }
        Value::Array(items) => items.iter().for_each(|item| collect_references(item, references)),
        _ => {}
    }
}
