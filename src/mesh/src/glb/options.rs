//! The content of a GLB besides the mesh or the path.

use serde_json::Value;

use super::placement::Up;

/// The contents of a GLB besides the mesh or the path.
#[derive(Clone, Debug)]
pub struct Options {
    /// The name of the object in a viewer's list of objects.
    pub name: String,
    /// The direction that is up in the object's frame.
    pub up: Up,
    /// The scene's `extras`; omitted if null.
    pub extras: Value,
}
