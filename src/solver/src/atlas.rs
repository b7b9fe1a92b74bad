//! The atlas of the parallel module.

mod answer;
mod arc;
mod arrangement;
mod chart;
mod clip;
mod compute;
mod continuation;
mod cover;
mod crossings;
mod cubic;
mod edges;
mod enclosure;
mod fold;
mod interior;
mod leg_one;
mod path;
mod place;
mod regions;
mod request;
mod scalar;
mod segment_grid;
mod target;
mod trace;

pub use answer::{Atlas, Curve, CurveKind, Face, PointKind, Region, SpecialPoint};
pub use compute::atlas;
pub use request::{AtlasError, AtlasRequest, Space, SpecialMachine, Window};
