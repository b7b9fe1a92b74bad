//! The workspace of the working mode: volumes, surfaces, slices and membership.
//!
//! All guideways are parallel to z, so alpha and every constraint but the strokes and the table's plane
//! depend on (x, y) alone, and the workspace is a set of vertical columns over a plane domain: nothing
//! is sampled in three dimensions. The height over the table is linear along a column. The domain's boundary is found by root-finding on the constraints.

mod agreement;
mod column;
mod contains;
mod cover;
pub mod dexterity;
mod domain;
mod estimate;
mod fold;
mod image;
mod measure;
mod observer;
mod path;
mod plane;
mod quadrature;
mod request;
mod root;
mod slice;
mod surface;

pub use agreement::agree;
pub use contains::{Membership, contains};
pub use domain::Binding;
pub use estimate::expected_triangles;
pub use measure::{Measure, Volume, measure};
pub use observer::{Observer, Unobserved};
pub use request::{Kind, Request, WorkspaceError};
pub use slice::{Contour, Polygon, Slice, slice};
pub use surface::{Surface, surface, surface_within};
