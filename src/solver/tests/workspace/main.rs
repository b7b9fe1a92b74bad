//! The workspace compared with independent truth: published figures, columns on a lattice, margins.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]
#![allow(clippy::cast_precision_loss, clippy::cast_possible_truncation, reason = "counts are small")]

// Shared code.
/// Columns on a lattice, computed by the inverse solution and the margins alone.
mod column_lattice;
#[path = "../support/lengths.rs"]
mod lengths;
#[path = "../support/machines.rs"]
mod machines;
#[path = "../support/random.rs"]
mod random;
/// Requests.
mod requests;
/// Components, genus and faults of a surface.
mod topology;

// Tests. Each module tests one function, or one property of several.
/// Surfaces of workspaces that consist of several components, have holes, or touch themselves.
mod components;
/// Grids, regions and volumes of dexterity maps.
mod dexterity;
/// Grids, surfaces and largest values of error maps.
mod error_map;
/// Workspaces of linear deltas against closed forms.
mod linear_delta;
/// Machines whose strokes are many times as long as the legs, and the estimate of triangles.
mod long_strokes;
/// Volumes and areas.
mod measure;
/// Membership of points.
mod membership;
/// Progress and cancellation.
mod observer;
/// Inclinations that reach a point.
mod orientations;
/// Partitions of a workspace: their areas and volumes sum to the whole.
mod partition;
/// Workspaces that earlier versions computed wrongly.
mod regressions;
/// Slices at a height, and their lines of constant alpha.
mod slices;
/// Surfaces: closed, oriented, within the tolerance.
mod surface;
/// The table as a limit of all of the above.
mod table_clearance;
/// The margin of the table's plane at one posture.
mod table_clearance_margin;
