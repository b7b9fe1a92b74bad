//! The workspace compared with independent truth: published figures, brute-force columns, its own margins.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]
#![allow(clippy::cast_precision_loss, clippy::cast_possible_truncation, reason = "counts are small")]

#[path = "workspace/brute.rs"]
mod brute;
#[path = "workspace/clearance.rs"]
mod clearance;
#[path = "workspace/clearance_margin.rs"]
mod clearance_margin;
#[path = "workspace/dexterity.rs"]
mod dexterity;
#[path = "workspace/long_strokes.rs"]
mod long_strokes;
#[path = "workspace/lost.rs"]
mod lost;
#[path = "workspace/machines.rs"]
mod machines;
#[path = "workspace/measure.rs"]
mod measure;
#[path = "workspace/membership.rs"]
mod membership;
#[path = "workspace/orientations.rs"]
mod orientations;
#[path = "workspace/partition.rs"]
mod partition;
#[path = "workspace/pieces.rs"]
mod pieces;
#[path = "workspace/slices.rs"]
mod slices;
#[path = "workspace/surface.rs"]
mod surface;
#[path = "workspace/topology.rs"]
mod topology;
#[path = "workspace/watched.rs"]
mod watched;
