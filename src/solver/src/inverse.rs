//! Inverse kinematics: from a position of platform, tool or part to the sliders (section III.C).

pub(crate) mod first_leg;
mod legs;
mod obstacle;
mod part;
mod platform;
mod tool;
mod track;

pub use part::{part, part_working};
pub use platform::{platform, platform_working};
pub use tool::{tool, tool_working};
