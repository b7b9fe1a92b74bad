//! Schemas of bodies that have no type of their own. The schemas have no descriptions, so some types have no doc
//! comments.

use serde_json::Value;
use utoipa::openapi::schema::OneOfBuilder;
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

/// The summary of a workspace, a family, a dexterity map or an error map.
pub(crate) struct Summary;

/// The summary of a workspace or a family.
pub(crate) struct WorkspaceAnswer;

/// The points of a dexterity map or of an error map.
pub(crate) struct MapCells;

/// The report on a tool path, or another answer about a program.
pub(crate) struct ToolpathResult;

// A mesh as JSON.
#[expect(dead_code, reason = "only its schema is used")]
#[derive(ToSchema)]
#[schema(as = Mesh)]
pub(crate) struct MeshObject {
    /// Always `mm`.
    unit: String,
    /// Coordinates, three for each vertex.
    positions: Vec<f64>,
    /// Vertices, three for each triangle.
    indices: Vec<u32>,
    /// The tag of each vertex.
    tags: Vec<u8>,
    /// The tag of each triangle.
    triangle_tags: Vec<u8>,
    /// The meanings of the tags.
    palette: Vec<Swatch>,
    /// Machine, request and frame.
    extras: serde_json::Map<String, Value>,
}

// The meaning of a tag.
#[expect(dead_code, reason = "only its schema is used")]
#[derive(ToSchema)]
struct Swatch {
    /// The name of a constraint.
    name: String,
    /// Red, green and blue in sRGB.
    rgb: [u8; 3],
}

fn one_of(names: &[&str]) -> OneOfBuilder {
    names.iter().fold(OneOfBuilder::new(), |schemas, name| schemas.item(Ref::from_schema_name(*name)))
}

impl PartialSchema for Summary {
    fn schema() -> RefOr<Schema> {
        one_of(&["WorkspaceSummary", "FamilySummary", "DexteritySummary", "ErrorMapSummary"]).into()
    }
}

impl ToSchema for Summary {}

impl PartialSchema for MapCells {
    fn schema() -> RefOr<Schema> {
        one_of(&["DexterityCells", "ErrorCells"]).into()
    }
}

impl ToSchema for MapCells {}

impl PartialSchema for ToolpathResult {
    fn schema() -> RefOr<Schema> {
        one_of(&["ToolpathReport", "Window", "Placement", "OriginsSummary"]).into()
    }
}

impl ToSchema for ToolpathResult {}

impl PartialSchema for WorkspaceAnswer {
    fn schema() -> RefOr<Schema> {
        one_of(&["WorkspaceSummary", "FamilySummary"]).into()
    }
}

impl ToSchema for WorkspaceAnswer {}
