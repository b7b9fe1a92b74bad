//! Inverse kinematics: from a position of platform, tool or part to the sliders (section III.C).

mod infeasibility;
mod leg_one_closure;
pub(crate) mod leg_one_cubic;
mod leg_one_height;
mod leg_one_pose;
mod locus_solver;
mod parallelogram_leg;
mod part;
mod platform;
mod platform_locus;
mod solutions;
mod tool;

pub(crate) use part::part_working_near;
pub use part::{part, part_every_working, part_working};
pub use platform::{platform, platform_working};
pub use tool::{tool, tool_every_working, tool_working};
