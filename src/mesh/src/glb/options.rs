//! What a GLB contains besides the mesh.

use serde_json::Value;

use super::placement::Up;

/// The contents of a GLB besides the mesh.
#[derive(Clone, Debug)]
pub struct Options {
    /// The name of the mesh in a viewer's list of objects.
    pub name: String,
    /// The direction that is up in the mesh's frame.
    pub up: Up,
    /// The angle between two triangles, in radians, from which their edge is shown sharp. Edges between two tags
    /// always are.
    pub crease: f64,
    /// The scene's `extras`; omitted if null.
    pub extras: Value,
}
