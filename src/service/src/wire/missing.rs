//! Finds all missing fields of a JSON body by its schema. The parser stops at the first.

use std::collections::BTreeMap;

use serde_json::Value;
use utoipa::ToSchema;
use utoipa::openapi::schema::Object;
use utoipa::openapi::{RefOr, Schema};

use crate::wire::error::FieldError;
use crate::wire::json_pointer::push_segment;

/// The missing fields of a body for the type `T`, the outer ones first.
pub(crate) fn missing_fields<T: ToSchema>(body: &[u8]) -> Vec<FieldError> {
    let Ok(body) = serde_json::from_slice::<Value>(body) else { return Vec::new() };
    let mut named = Vec::new();
    T::schemas(&mut named);
    let mut search = Search { named: named.into_iter().collect(), found: Vec::new() };
    search.visit(&T::schema(), &body, "");
    search.found
}

struct Search {
    /// Schemas by the names that references have.
    named: BTreeMap<String, RefOr<Schema>>,
    found: Vec<FieldError>,
}

impl Search {
    fn visit(&mut self, schema: &RefOr<Schema>, value: &Value, pointer: &str) {
        let (Some(object), Value::Object(fields)) = (self.object(schema).cloned(), value) else { return };
        for name in object.required.iter().filter(|name| !fields.contains_key(*name)) {
            self.found.push(FieldError::missing(pointer_to(pointer, name), name));
        }
        for (name, schema) in &object.properties {
            if let Some(value) = fields.get(name) {
                self.visit(schema, value, &pointer_to(pointer, name));
            }
        }
    }

    /// The only kind of object that a schema allows; none if it allows several.
    fn object<'a>(&'a self, schema: &'a RefOr<Schema>) -> Option<&'a Object> {
        let items = match schema {
            RefOr::Ref(reference) => {
                return self.object(self.named.get(reference.ref_location.rsplit('/').next()?)?);
            }
            RefOr::T(Schema::Object(object)) => return (!object.properties.is_empty()).then_some(object),
            RefOr::T(Schema::OneOf(any)) => &any.items,
            RefOr::T(Schema::AnyOf(any)) => &any.items,
            RefOr::T(Schema::AllOf(all)) => &all.items,
            RefOr::T(_) => return None,
        };
        let mut objects = items.iter().filter_map(|item| self.object(item));
        objects.next().filter(|_| objects.next().is_none())
    }
}

fn pointer_to(pointer: &str, name: &str) -> String {
    let mut pointer = pointer.to_owned();
    push_segment(&mut pointer, name);
    pointer
}
