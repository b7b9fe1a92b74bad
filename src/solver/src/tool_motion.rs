//! The tool's end and axis in the part frame, and their rates for rates of the joints.

use nalgebra::Vector3;

use crate::machine::Machine;
use crate::pose::PlatformPose;
use crate::turns::Turns;

/// The tool at one place: the terms of Eq (26).
#[derive(Clone, Copy, Debug)]
pub(crate) struct ToolMotion {
    turns: Turns,
    /// Sine and cosine of phi1.
    inclination: [f64; 2],
    pose: PlatformPose,
    /// z less that of the tilting axis.
    height: f64,
    /// The tool's end in the direction of y of the tilted table.
    across: f64,
    tool_length: f64,
    offset: f64,
}

impl ToolMotion {
    pub(crate) fn at(machine: &Machine, pose: &PlatformPose, turns: Turns, tool_length: f64) -> Self {
        let (inclination, [s1, c1]) = (turns.inclination(), turns.tilt);
        let height = pose.z - machine.table().da;
        let across = tool_length * inclination[0] - pose.y * c1 - height * s1;
        Self { turns, inclination, pose: *pose, height, across, tool_length, offset: machine.table().dt }
    }

    /// The tool's end and axis: Eq (26).
    pub(crate) fn position(&self) -> [Vector3<f64>; 2] {
        let ([s1, c1], [s2, c2], [sp, cp]) = (self.turns.tilt, self.turns.rotary, self.inclination);
        let tip = Vector3::new(
            self.pose.x * c2 + self.across * s2,
            self.across * c2 - self.pose.x * s2,
            self.pose.y * s1 + self.offset - self.height * c1 - self.tool_length * cp,
        );
        [tip, Vector3::new(-sp * s2, -sp * c2, cp)]
    }

    /// Their derivatives for these rates of the platform's pose, theta1 and theta2.
    pub(crate) fn rates(&self, pose: &PlatformPose, [tilt, rotary]: [f64; 2]) -> [Vector3<f64>; 2] {
        let ([s1, c1], [s2, c2], [sp, cp]) = (self.turns.tilt, self.turns.rotary, self.inclination);
        let inclination = pose.alpha - tilt;
        let (y, height) = (self.pose.y, self.height);
        let across =
            self.tool_length * cp * inclination - pose.y * c1 - pose.z * s1 + (y * s1 - height * c1) * tilt;
        let tip = Vector3::new(
            pose.x * c2 + across * s2 + (self.across * c2 - self.pose.x * s2) * rotary,
            across * c2 - pose.x * s2 - (self.pose.x * c2 + self.across * s2) * rotary,
            pose.y * s1 - pose.z * c1 + (y * c1 + height * s1) * tilt + self.tool_length * sp * inclination,
        );
        let axis = Vector3::new(
            -cp * s2 * inclination - sp * c2 * rotary,
            -cp * c2 * inclination + sp * s2 * rotary,
            -sp * inclination,
        );
        [tip, axis]
    }
}
