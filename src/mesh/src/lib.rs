//! Indexed triangle meshes, in millimetres and in some right-handed frame: measures, audits, plane sections
//! and encoders. What is meshed, and for whom, is the caller's business.
//!
//! Geometry is kept welded (a vertex is stored once and shared), so that a closed surface is closed by its
//! indices and not by a comparison of coordinates. Only GLB, which has one normal a vertex, is given split
//! vertices.

mod audit;
mod edges;
mod facet;
mod fault;
mod forest;
pub mod glb;
mod groups;
pub mod json;
mod measure;
mod mesh;
pub mod packed;
mod palette;
pub mod ply;
mod section;
mod shading;
pub mod stl;
mod sum;
mod vector;

pub use audit::Audit;
pub use fault::MeshFault;
pub use measure::Bounds;
pub use mesh::Mesh;
pub use palette::Swatch;
pub use section::Contour;
