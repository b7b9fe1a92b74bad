//! The handlers, one module for each group of paths. `router` says how to add a route.

pub(crate) mod atlas;
pub(crate) mod batch;
pub(crate) mod calibration;
pub(crate) mod dexterity;
pub(crate) mod error_budget;
pub(crate) mod jobs;
pub(crate) mod joint_program;
pub(crate) mod kinematics;
pub(crate) mod machines;
pub(crate) mod origins;
pub(crate) mod placement;
pub(crate) mod programs;
pub(crate) mod results;
pub(crate) mod service;
pub(crate) mod toolpath;
pub(crate) mod toolpath_rows;
pub(crate) mod window;
pub(crate) mod workspace;
