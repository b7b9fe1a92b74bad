//! Inverse kinematics: from a position of platform, tool or part to the sliders (section III.C).

mod infeasibility;
mod leg_one_closure;
pub(crate) mod leg_one_cubic;
mod leg_one_height;
mod leg_one_pose;
mod locus_rows;
mod locus_solver;
mod parallelogram_leg;
mod part;
mod part_rows;
mod platform;
mod platform_locus;
mod platform_rows;
mod solutions;
mod tool;
mod tool_rows;

pub(crate) use part::part_working_near;
pub use part::{part, part_every_working, part_working};
pub use part_rows::part_working_rows;
pub use platform::{platform, platform_working};
pub use platform_rows::platform_working_rows;
pub use tool::{tool, tool_every_working, tool_working};
pub use tool_rows::tool_working_rows;
