//! Calibration through the public functions: measurements of machines whose parameters are known.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]

// Shared code.
/// Poses, noise, and machines that deviate.
mod bench;
#[path = "../support/lengths.rs"]
mod lengths;
#[path = "../support/machines.rs"]
mod machines;
#[path = "../support/random.rs"]
mod random;

// Tests.
mod gross_errors;
mod knowledge;
mod next_poses;
mod ranks;
mod recovery;
mod refusals;
