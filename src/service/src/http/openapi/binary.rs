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

/// A server-sent event whose data is a job as JSON.
pub(crate) struct JobEvent;

impl PartialSchema for JobEvent {
    fn schema() -> RefOr<Schema> {
        let text = || ObjectBuilder::new().schema_type(Type::String);
        let event = text().description(Some("`end` for the last event; other events do not have it."));
        ObjectBuilder::new()
            .schema_type(Type::Object)
            .property("data", text().content_media_type("application/json"))
            .property("event", event)
            .property("id", text())
            .required("data")
            .required("id")
            .into()
    }
}

impl ToSchema for JobEvent {}

impl PartialSchema for Text {
    fn schema() -> RefOr<Schema> {
        ObjectBuilder::new().schema_type(Type::String).into()
    }
}

impl ToSchema for Text {}

/// The summary of a workspace, the table of a family, or the figures of a dexterity map.
pub(crate) struct Summary;

/// A summary, or with `format=json` a mesh.
pub(crate) struct SummaryOrMesh;

fn any_of(schemas: impl IntoIterator<Item = RefOr<Schema>>) -> RefOr<Schema> {
    schemas.into_iter().fold(AnyOfBuilder::new(), AnyOfBuilder::item).into()
}

fn summaries(names: &[&str]) -> Vec<RefOr<Schema>> {
    names.iter().map(|name| Ref::from_schema_name(*name).into()).collect()
}

impl PartialSchema for Summary {
    fn schema() -> RefOr<Schema> {
        any_of(summaries(&["WorkspaceSummary", "FamilySummary", "DexteritySummary"]))
    }
}

impl ToSchema for Summary {}

impl PartialSchema for SummaryOrMesh {
    fn schema() -> RefOr<Schema> {
        let mesh = ObjectBuilder::new().schema_type(Type::Object).required("positions").required("indices");
        any_of(summaries(&["WorkspaceSummary", "FamilySummary"]).into_iter().chain([mesh.into()]))
    }
}

impl ToSchema for SummaryOrMesh {}
