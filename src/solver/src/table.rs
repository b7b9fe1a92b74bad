//! The tilting table and the tool: Eqs (7)-(9), (14), (26), (27).

use std::f64::consts::TAU;

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
    let asked = [alpha - phi1, -phi2].map(|angle| Winding { angle, turns: 0.0 });
    let [theta1, theta2] = table_windings(machine, asked, [None; 2]).map(|winding| winding.value);
    TableAngles { theta1, theta2 }
}

/// An angle in whole turns and the rest, which keeps the digits of both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Winding {
    /// The rest, rad.
    pub angle: f64,
    /// Whole turns.
    pub turns: f64,
}

/// A table's angle on one of its windings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wound {
    /// Whole turns beside the angle that was asked for.
    pub turns: f64,
    /// The angle with its turns, rad; within the range, should rounding alone put it outside.
    pub value: f64,
}

/// The windings of theta1 and theta2 within the machine's ranges: of several, the one nearest to
/// `near`, rad, where that is given; else the winding asked for; else the one nearest to zero. An
/// angle without a winding in its range stays nearest to zero.
pub fn table_windings(machine: &Machine, asked: [Winding; 2], near: [Option<f64>; 2]) -> [Wound; 2] {
    let limits = machine.limits();
    [wound(limits.tilt, asked[0], near[0]), wound(limits.rotary, asked[1], near[1])]
}

/// Rounding of an angle of some turns, rad.
const ROUNDING: f64 = 1e-13;

fn wound([low, high]: [f64; 2], Winding { angle, turns }: Winding, near: Option<f64>) -> Wound {
    let nearest = |place: f64| ((place - angle) / TAU).round();
    let (first, last) = (((low - ROUNDING - angle) / TAU).ceil(), ((high + ROUNDING - angle) / TAU).floor());
    let admissible = first <= last;
    let turns = match near {
        _ if !admissible => nearest(0.0),
        Some(near) => nearest(near).clamp(first, last),
        None if (first..=last).contains(&turns) => turns,
        None => nearest(0.0).clamp(first, last),
    };
    let value = angle + TAU * turns;
    let within = if admissible && turns != 0.0 { value.clamp(low, high) } else { value };
    Wound { turns, value: within }
}
