//! The atlas of the parallel module: the plane of the platform and that of the sliders, divided by the number of
//! solutions.
//!
//! [`atlas()`] computes the curves on which solutions merge, the regions between them, and the working mode's
//! domain. An [`Observer`](crate::workspace::Observer) can stop it.
//!
#![doc = include_str!("atlas/derivation.md")]

mod answer;
mod arc;
mod arc_node;
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
mod rectangle;
mod regions;
mod request;
mod scalar;
mod search;
mod segment_grid;
mod target;
mod trace;

pub use answer::{Atlas, Curve, CurveKind, Face, PointKind, Region, SpecialPoint};
pub use compute::atlas;
pub use request::{AtlasError, AtlasRequest, Space, SpecialMachine, Window};
