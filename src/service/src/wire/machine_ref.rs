//! The machine of a request: a name, or a machine object.

use std::fmt;

use serde::de::value::MapAccessDeserializer;
use serde::de::{Error, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};
use utoipa::ToSchema;

use crate::wire::error::{FieldError, OperationError};
use crate::wire::machine::MachineObject;
use crate::wire::parse::parse_body;

/// Name of the built-in reference machine: the default machine of every request.
pub(crate) const REFERENCE: &str = "verne";

/// The default of a parameter `machine`.
pub(crate) fn reference_name() -> String {
    REFERENCE.to_owned()
}

/// The machine of a request.
#[derive(Clone, Debug, ToSchema)]
#[serde(untagged)]
pub(crate) enum MachineRef {
    /// The name of a published machine; GET /machines lists them.
    Name(String),
    /// A custom machine.
    Object(Box<MachineObject>),
}

impl MachineRef {
    /// The machine of a query parameter: a name, or a machine object as JSON.
    ///
    /// # Errors
    ///
    /// The JSON is no machine object. The pointer of an error begins with `/machine`.
    pub(crate) fn of_parameter(text: &str) -> Result<Self, OperationError> {
        if !text.trim_start().starts_with('{') {
            return Ok(Self::Name(text.to_owned()));
        }
        let object = parse_body::<MachineObject>(text.as_bytes()).map_err(|error| match error {
            OperationError::Fields(faults) => {
                let faults = faults.into_iter();
                let moved =
                    faults.map(|fault| FieldError::new(format!("/machine{}", fault.pointer), fault.detail));
                OperationError::Fields(moved.collect())
            }
            OperationError::Syntax(reason) => {
                OperationError::Fields(vec![FieldError::new("/machine", format!("is no JSON: {reason}"))])
            }
            other => other,
        })?;
        Ok(Self::Object(Box::new(object)))
    }
}

impl Default for MachineRef {
    fn default() -> Self {
        Self::Name(reference_name())
    }
}

impl<'de> Deserialize<'de> for MachineRef {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(NameOrObject)
    }
}

/// Decides by the JSON type: an error inside an object then has its pointer.
struct NameOrObject;

impl<'de> Visitor<'de> for NameOrObject {
    type Value = MachineRef;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the name of a machine or a machine object")
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<MachineRef, E> {
        Ok(MachineRef::Name(name.to_owned()))
    }

    fn visit_map<A: MapAccess<'de>>(self, fields: A) -> Result<MachineRef, A::Error> {
        MachineObject::deserialize(MapAccessDeserializer::new(fields)).map(Box::new).map(MachineRef::Object)
    }
}
