//! The plane domain as triangles, or as the sides of its boundary.
//!
//! A lattice of squares, two triangles each, is refined and cut. Each square is independent of the others, so threads
//! share the work and the result does not depend on their number.

mod curve_refinement;
mod ear_clipping;
mod edge_criteria;
mod face_triangles;
mod fast_hash;
mod lattice;
mod mesh;
mod patch;
mod refinement;
mod sample;
mod trace;
mod triangle_cut;
mod triangle_samples;
mod weld;

pub(super) use mesh::{BoundarySide, PlaneMesh};
pub(super) use trace::LATTICES;
