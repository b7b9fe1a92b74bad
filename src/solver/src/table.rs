//! The tilting table and the tool: Eqs (7)-(9), (14), (26), (27).

use crate::angle::sin_cos;
use crate::machine::Machine;
use crate::pose::{PartPose, PlatformPose, Point, TableAngles};

/// The tool centre point U in the base frame, for a tool of length `tool_length` from P (Eq (27)).
pub fn tool_point(pose: &PlatformPose, tool_length: f64) -> Point {
    let (s, c) = sin_cos(pose.alpha);
    [pose.x, pose.y - tool_length * s, pose.z + tool_length * c]
}

/// The tool's pose in the table frame (Eq (26)).
pub fn part_pose(machine: &Machine, pose: &PlatformPose, table: TableAngles, tool_length: f64) -> PartPose {
    let offsets = machine.table();
    let phi1 = pose.alpha - table.theta1;
    let ((s1, c1), (s2, c2)) = (sin_cos(table.theta1), sin_cos(table.theta2));
    let (sp, cp) = sin_cos(phi1);
    let height = pose.z - offsets.da;
    let v1 = tool_length * sp - pose.y * c1 - height * s1;
    PartPose {
        x: pose.x * c2 + v1 * s2,
        y: -pose.x * s2 + v1 * c2,
        z: pose.y * s1 + offsets.dt - height * c1 - tool_length * cp,
        phi1,
        phi2: -table.theta2,
    }
}

/// The table's angles that go with a platform angle and a tool orientation (Eqs (9), (14)), each
/// turned by whole revolutions into the machine's range where one of its values lies there, and
/// otherwise to the value nearest to zero.
pub fn table_angles(machine: &Machine, alpha: f64, phi1: f64, phi2: f64) -> TableAngles {
    let limits = machine.limits();
    TableAngles { theta1: turned_into(limits.tilt, alpha - phi1), theta2: turned_into(limits.rotary, -phi2) }
}

fn turned_into([low, high]: [f64; 2], angle: f64) -> f64 {
    use std::f64::consts::TAU;
    if (low..=high).contains(&angle) {
        return angle;
    }
    let nearest = angle - TAU * (angle / TAU).round();
    [nearest, nearest + TAU, nearest - TAU]
        .into_iter()
        .find(|turned| (low..=high).contains(turned))
        .unwrap_or(nearest)
}
