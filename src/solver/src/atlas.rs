//! The atlas of the parallel module.

mod answer;
mod request;

pub use answer::{Atlas, Curve, CurveKind, Face, PointKind, Region, SpecialPoint};
pub use request::{AtlasError, AtlasRequest, Space, Window};
