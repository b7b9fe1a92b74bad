//! The tool in the machine's or the part frame.

use nalgebra::Vector3;

use crate::pose::{PlatformPose, Point, TableAngles};

/// The frame in which a tool is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ToolFrame {
    /// The base frame; z points down.
    Machine,
    /// The part frame, with the table at the angles that the control indicates.
    Part(TableAngles),
}

/// The tool in a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tool {
    /// The tool's end, mm.
    pub tip: Point,
    /// The tool's axis: a unit vector from its end to its holder.
    pub axis: [f64; 3],
}

/// The tool's end and axis in the base frame.
pub(super) fn tip_and_axis(pose: &PlatformPose, tool_length: f64) -> [Vector3<f64>; 2] {
    let (s, c) = pose.alpha.sin_cos();
    let axis = Vector3::new(0.0, s, -c);
    [Vector3::new(pose.x, pose.y, pose.z) - tool_length * axis, axis]
}
