//! Atlases against the solver's own answers: numbers of solutions, areas, curves, the working mode's domain.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

// Shared code.
/// The solver's answer at points of the plane, compared with that of an atlas.
mod comparison;
#[path = "../support/lengths.rs"]
mod lengths;
#[path = "../support/machines.rs"]
mod machines;
#[path = "../support/random.rs"]
mod random;

// Tests.
/// Areas of regions against a lattice of points, and against the whole window.
mod areas;
/// What happens to the solutions on curves and at special points.
mod curves;
/// Numbers of solutions in regions, and the working mode's domain.
mod numbers;
/// Windows, tolerances, refusals, cancellation, equal answers.
mod requests;
/// Linear deltas, machines with equal offsets, and machines near them.
mod special_machines;
