//! Inverse kinematics: from a position of platform, tool or part to the sliders (section III.C).

pub(crate) mod first_leg;
mod legs;
mod level;
mod obstacle;
mod part;
mod platform;
mod tool;
mod track;

pub(crate) use level::LITTLE;
pub use part::{part, part_every_working, part_working};
pub use platform::{platform, platform_working};
pub use tool::{tool, tool_every_working, tool_working};
