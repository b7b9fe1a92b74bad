//! One function for each operation: HTTP in, a typed answer out.

pub mod batch;
pub mod kinematics;
pub mod machines;
pub mod service;
