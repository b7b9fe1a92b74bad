//! Proofs of solutions: boxes that contain exactly one, and that there are no others.
//!
#![doc = include_str!("certificate/derivation.md")]

mod angle;
mod answer;
mod assemblies;
mod assembly_equations;
mod bounded_polynomial;
mod chart_equations;
mod circle_search;
mod enclosure;
mod krawczyk;
mod leg_one_equations;
mod leg_one_root;
mod locus;
mod orientation;
mod plane_search;
mod postures;
mod rod_equations;

pub use answer::{Certification, Incomplete, PostureBox, Scope, Unproved};
pub use assemblies::certify_forward;
pub use orientation::EnclosedOrientation;
pub use postures::{certify_part, certify_platform, certify_tool};
