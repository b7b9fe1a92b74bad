//! Schemas of bodies that have no type of their own. The schemas have no descriptions, so some types have no doc
//! comments.

use utoipa::openapi::schema::{AnyOfBuilder, ObjectBuilder, Type};
use utoipa::openapi::{Ref, RefOr, Schema};
use utoipa::{PartialSchema, ToSchema};

#[derive(ToSchema)]
#[schema(value_type = String, format = Binary)]
pub(crate) struct Binary(());

#[derive(ToSchema)]
#[schema(value_type = String)]
pub(crate) struct Text(());

// A server-sent event with a job as JSON.
#[expect(dead_code, reason = "only its schema is used")]
#[derive(ToSchema)]
pub(crate) struct JobEvent {
    #[schema(content_media_type = "application/json")]
    data: String,
    /// `end` for the last event; other events do not have it.
    #[schema(nullable = false)]
    event: Option<String>,
    id: String,
}

/// The summary of a workspace, a family or a dexterity map.
pub(crate) struct Summary;

/// The summary of a workspace or a family, or with `format=json` a mesh.
pub(crate) struct SummaryOrMesh;

fn any_of(names: &[&str]) -> AnyOfBuilder {
    names.iter().fold(AnyOfBuilder::new(), |schemas, name| schemas.item(Ref::from_schema_name(*name)))
}

impl PartialSchema for Summary {
    fn schema() -> RefOr<Schema> {
        any_of(&["WorkspaceSummary", "FamilySummary", "DexteritySummary"]).into()
    }
}

impl ToSchema for Summary {}

impl PartialSchema for SummaryOrMesh {
    fn schema() -> RefOr<Schema> {
        let mesh = ObjectBuilder::new().schema_type(Type::Object).required("positions").required("indices");
        any_of(&["WorkspaceSummary", "FamilySummary"]).item(mesh).into()
    }
}

impl ToSchema for SummaryOrMesh {}
