//! A short program in a JSON body: its points.

use serde::Deserialize;
use utoipa::openapi::schema::{
    AdditionalProperties, AnyOfBuilder, ArrayBuilder, ArrayItems, ObjectBuilder, Type,
};
use utoipa::openapi::{RefOr, Schema};
use utoipa::{PartialSchema, ToSchema};
use verne_program::Row;

/// The points of a program.
#[derive(Clone, Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ProgramPoints {
    /// Points `[x, y, z]`, `[x, y, z, phi1, phi2]` or `[x, y, z, i, j, k]`, or objects with these names and optionally
    /// `feed` (mm/min, or degrees per minute if only the axis moves), `kind` (`feed` or `rapid`) and `line`. Without an
    /// orientation the axis is (0, 0, 1). A point's line is its number from 1 unless it has `line`. The service rejects
    /// other names.
    #[schema(value_type = Vec<PointSchema>)]
    pub points: Vec<Row>,
}

/// The schema of a point.
struct PointSchema;

impl PartialSchema for PointSchema {
    fn schema() -> RefOr<Schema> {
        let numbers = ArrayBuilder::new()
            .items(ArrayItems::RefOrSchema(Box::new(f64::schema())))
            .min_items(Some(3))
            .max_items(Some(6));
        let object = ["x", "y", "z"].into_iter().fold(ObjectBuilder::new(), |object, name| {
            object.schema_type(Type::Object).property(name, f64::schema()).required(name)
        });
        let object = ["i", "j", "k", "phi1", "phi2", "feed"]
            .into_iter()
            .fold(object, |object, name| object.property(name, f64::schema()));
        let kind = ObjectBuilder::new().schema_type(Type::String).enum_values(Some(["feed", "rapid"]));
        let object = object
            .property("kind", kind)
            .property("line", u32::schema())
            .additional_properties(Some(AdditionalProperties::FreeForm(false)));
        AnyOfBuilder::new().item(numbers).item(object).into()
    }
}

impl ToSchema for PointSchema {}
