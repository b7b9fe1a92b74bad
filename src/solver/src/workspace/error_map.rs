//! Error maps: the errors of the tool over a workspace, for tolerances of the machine's parameters.
//!
//! At each node of a grid that is inside the workspace, and at each vertex of its surface, the
//! [error budget](crate::error_budget) of the posture there has four figures. In the base frame they depend on x and y
//! of the platform alone: a common shift of the sliders carries everything along. In the part frame the errors of the
//! table's axes grow with the distance from them.
//!
//! [`largest()`] continues from the greatest value that was found, as far as that leads upwards. It is the value at a
//! point of the workspace, so the true maximum is not less. Between the examined points there may be a greater one;
//! nothing is proved about that.

mod errors;
mod grid;
mod largest;
mod request;
mod slab;
mod surface_errors;

pub use errors::{ErrorKind, PointErrors, errors_at};
pub use grid::error_grid;
pub use largest::{Largest, largest};
pub use request::ErrorMapRequest;
pub use slab::{NodeErrors, error_slab};
pub use surface_errors::{SurfaceErrors, surface_errors};
