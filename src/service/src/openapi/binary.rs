//! Bodies that are not JSON.

use utoipa::openapi::schema::{AnyOfBuilder, ObjectBuilder, Type};
use utoipa::openapi::{KnownFormat, Ref, RefOr, Schema, SchemaFormat};
use utoipa::{PartialSchema, ToSchema};

/// Bytes.
pub(crate) struct Binary;

/// A text.
pub(crate) struct Text;

impl PartialSchema for Binary {
    fn schema() -> RefOr<Schema> {
        let format = SchemaFormat::KnownFormat(KnownFormat::Binary);
        ObjectBuilder::new().schema_type(Type::String).format(Some(format)).into()
    }
}

impl ToSchema for Binary {}

impl PartialSchema for Text {
    fn schema() -> RefOr<Schema> {
        ObjectBuilder::new().schema_type(Type::String).into()
    }
}

impl ToSchema for Text {}

/// A summary, or with `format=json` a mesh.
pub(crate) struct SummaryOrMesh;

impl PartialSchema for SummaryOrMesh {
    fn schema() -> RefOr<Schema> {
        let mesh = ObjectBuilder::new().schema_type(Type::Object).required("positions").required("indices");
        AnyOfBuilder::new().item(Ref::from_schema_name("WorkspaceSummary")).item(mesh).into()
    }
}

impl ToSchema for SummaryOrMesh {}
