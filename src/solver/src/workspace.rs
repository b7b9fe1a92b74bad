//! The workspace of the working mode: volumes, surfaces, slices, membership and dexterity.
//!
//! All guideways are parallel to z. Therefore alpha and every constraint but the strokes and the table's plane
//! depend on (x, y) alone, and the workspace is a set of vertical columns over a plane domain. Root-finding on the
//! constraints gives the domain's boundary. The third dimension is not sampled.
//!
//! - [`measure()`]: volume and area with errors, by integration.
//! - [`surface()`], [`surface_within`]: the closed boundary surface within a tolerance; [`expected_triangles`]
//!   estimates its size, and [`agree`] compares it with the volume.
//! - [`slice()`]: the cut at a height, as polygons.
//! - [`contains()`]: whether points belong to the workspace, without a mesh.
//! - [`dexterity`]: the tool's inclinations that reach a part point.
//! - [`error_map`]: the errors of the tool, for tolerances of the machine's parameters.
//!
//! Every function takes a [`Request`] or a [`dexterity::DexterityRequest`]. Long computations report to an
//! [`Observer`] and stop when it asks.
//!
#![doc = include_str!("workspace/derivation.md")]

mod agreement;
mod column;
mod contains;
mod cover;
pub mod dexterity;
mod domain;
pub mod error_map;
mod feasible_intervals;
mod fold;
mod image;
mod measure;
pub(crate) mod observer;
mod plane;
mod quadrature;
mod request;
mod root;
mod slice;
mod surface;
mod triangle_estimate;
pub(crate) mod vector;

pub use agreement::agree;
pub use contains::{Membership, contains};
pub use domain::Binding;
pub use measure::{Measure, Volume, measure};
pub use observer::{Observer, Subprogress, Unobserved};
pub use request::{Kind, Request, WorkspaceError};
pub(crate) use root::zero;
pub(crate) use slice::nested;
pub use slice::{Contour, Polygon, Slice, slice};
pub use surface::{Surface, surface, surface_within};
pub use triangle_estimate::expected_triangles;
