//! Indexed triangle meshes in millimetres: measures, audits, plane sections and encoders. Paths as coloured lines. The
//! frame is any right-handed one. The crate does not know the meaning of a mesh.
//!
//! A vertex is stored once and shared. So a closed surface is closed by its indices, not by a comparison of
//! coordinates. Only GLB, which has one normal for each vertex, gets split vertices.

mod audit;
mod edges;
mod error;
mod facet;
pub mod glb;
mod groups;
pub mod json;
mod measure;
mod mesh;
pub mod packed;
mod palette;
mod path;
pub mod ply;
mod section;
mod shading;
pub mod stl;
mod sum;
mod union_find;
mod vector;

pub use audit::Audit;
pub use error::MeshError;
pub use measure::Bounds;
pub use mesh::Mesh;
pub use palette::Swatch;
pub use path::{ColourScale, Path, PathBuilder, Stroke};
pub use section::Contour;
