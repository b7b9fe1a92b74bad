//! Kinematics through the public functions: counts, coordinates, margins, velocities, refusals; against the published
//! reference sets, all solutions by brute force, and laws of the machine.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]

// Shared code.
#[path = "../support/lengths.rs"]
mod lengths;
#[path = "../support/machines.rs"]
mod machines;
/// All solutions by brute force, from the plain data of a machine, and tests of the oracle itself.
mod oracle;
#[path = "../support/questions.rs"]
mod questions;
#[path = "../support/random.rs"]
mod random;
/// The published reference sets of `tests/reference`.
mod reference_cases;
/// Random poses and sliders.
mod requests;

// Tests.
mod arbitrary_numbers;
mod axis;
mod certificates;
mod common_lift;
mod conditioning;
mod degenerate_angles;
mod error_budget;
mod family_edge_round_trip;
mod family_edge_sets;
mod interference;
mod invalid_machines;
mod leg_limits;
mod level_leg;
mod linear_delta;
mod margins;
mod parallel_singularity;
mod parameter_rates;
mod proportional_machine;
mod proportions;
mod reference_sets;
mod round_trip;
mod rows;
mod several_working_postures;
mod solution_counts;
mod symmetric_sliders;
mod symmetry_plane;
mod tool_jacobian;
mod unreachable;
mod velocities;
mod windings;
mod working_mode;
mod worst_margin;
