//! One function for each operation: HTTP in, a typed answer out.

pub(crate) mod batch;
pub(crate) mod contains;
pub(crate) mod dexterity;
pub(crate) mod jobs;
pub(crate) mod kinematics;
pub(crate) mod machines;
pub(crate) mod service;
pub(crate) mod workspace;
pub(crate) mod workspace_results;
