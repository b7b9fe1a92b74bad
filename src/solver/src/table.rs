//! The tilting table and the tool: Eqs (7)-(9), (14), (26), (27).

use std::f64::consts::TAU;

use crate::fast_math::sin_cos;
use crate::machine::Machine;
use crate::pose::{PartPose, PlatformPose, Point, TableAngles};

/// Computes the tool centre point U in the base frame, for a tool of length `tool_length` from P.
///
/// # Units
///
/// Millimetres and radians; z points down.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eq (27).
///
/// # Examples
///
/// ```
/// use verne_solver::{PlatformPose, tool_point};
///
/// let pose = PlatformPose { x: 10.0, y: 20.0, z: 1000.0, alpha: 0.0 };
/// assert_eq!(tool_point(&pose, 150.0), [10.0, 20.0, 1150.0]);
/// ```
pub fn tool_point(pose: &PlatformPose, tool_length: f64) -> Point {
    let (s, c) = sin_cos(pose.alpha);
    [pose.x, pose.y - tool_length * s, pose.z + tool_length * c]
}

/// Computes the tool's pose in the part frame from the platform's pose and the table's angles.
///
/// # Units
///
/// Millimetres and radians; Z of the part frame points up from the table.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (7), (8), (26).
///
/// # Examples
///
/// ```
/// use verne_solver::{Machine, PlatformPose, TableAngles, part_pose};
///
/// let pose = PlatformPose { x: 10.0, y: 20.0, z: 1000.0, alpha: 0.1 };
/// let level = TableAngles { theta1: 0.0, theta2: 0.0 };
/// let tool = part_pose(&Machine::verne(), &pose, level, 0.0);
/// assert_eq!([tool.x, tool.y, tool.z], [10.0, -20.0, 700.0], "da = 1500 and dt = 200");
/// assert_eq!(tool.phi1, 0.1);
/// ```
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

/// Computes the table's angles for a platform angle and a tool orientation: theta1 = alpha - phi1, theta2 = -phi2.
///
/// Each angle is moved by whole turns into the machine's range. An angle that has no value in its range is moved to its
/// value nearest to zero.
///
/// # Units
///
/// Radians.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (9), (14).
///
/// # Examples
///
/// ```
/// use verne_solver::{Machine, table_angles};
///
/// let table = table_angles(&Machine::verne(), 0.25, 0.75, 0.1);
/// assert_eq!((table.theta1, table.theta2), (-0.5, -0.1));
/// ```
pub fn table_angles(machine: &Machine, alpha: f64, phi1: f64, phi2: f64) -> TableAngles {
    let given = [alpha - phi1, -phi2].map(|angle| SplitAngle { remainder: angle, turns: 0.0 });
    let [theta1, theta2] = table_windings(machine, given, [None; 2]).map(|winding| winding.value);
    TableAngles { theta1, theta2 }
}

/// An angle as whole turns and a remainder. Both keep their digits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SplitAngle {
    /// The remainder, rad.
    pub remainder: f64,
    /// Whole turns.
    pub turns: f64,
}

/// A value of a table angle: the given angle moved by whole turns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Winding {
    /// Whole turns in addition to the remainder.
    pub turns: f64,
    /// The angle including its turns, rad. It is clamped to the range if rounding alone puts it outside.
    pub value: f64,
}

/// Moves theta1 and theta2 by whole turns into the machine's ranges.
///
/// Of several values in a range the function takes the one nearest to `near` if that is given, else the given value,
/// else the one nearest to zero; of two that are equally near, the greater one. An angle that has no value in its range
/// is moved to its value nearest to zero.
///
/// # Units
///
/// Radians, and whole turns.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (9), (14) determine the angles
/// up to whole turns.
///
/// # Examples
///
/// ```
/// use std::f64::consts::TAU;
/// use verne_solver::{Machine, SplitAngle, table_windings};
///
/// let given = [0.5, 1.0].map(|angle| SplitAngle { remainder: angle, turns: 0.0 });
/// let [_, theta2] = table_windings(&Machine::verne(), given, [None, Some(-5.0)]);
/// assert_eq!(theta2.turns, -1.0, "1 - 2π is nearer to -5 and within ±2π");
/// assert_eq!(theta2.value, 1.0 - TAU);
/// ```
#[inline]
pub fn table_windings(machine: &Machine, given: [SplitAngle; 2], near: [Option<f64>; 2]) -> [Winding; 2] {
    let limits = machine.limits();
    let rotary = limits.rotary.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
    [winding(limits.tilt, given[0], near[0]), winding(rotary, given[1], near[1])]
}

/// Counts the values of theta2, by whole turns apart, that are within the machine's range. `None`: the range has no
/// limit.
///
/// # Units
///
/// Radians, and whole turns.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eq (9) determines theta2 up to
/// whole turns.
///
/// # Examples
///
/// ```
/// use verne_solver::{Machine, rotary_windings};
///
/// // The range is ±2π: 1 and 1 - 2π are in it, and of 0 also ±2π.
/// assert_eq!(rotary_windings(&Machine::verne(), 1.0), Some(2));
/// assert_eq!(rotary_windings(&Machine::verne(), 0.0), Some(3));
/// ```
pub fn rotary_windings(machine: &Machine, theta2: f64) -> Option<u32> {
    let (first, last) = admissible_turns(machine.limits().rotary?, theta2);
    Some(if first <= last { count(last - first) } else { 0 })
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a whole number; a range has at most 200 turns"
)]
fn count(turns: f64) -> u32 {
    turns as u32 + 1
}

/// Rounding of an angle of some turns, rad.
const ROUNDING: f64 = 1e-13;

/// Part of a turn within which two values are equally near: rounding does not choose between them.
const TIE: f64 = 1e-10;

/// The least and the greatest number of whole turns that move an angle into a range; none if the first is greater.
fn admissible_turns([low, high]: [f64; 2], angle: f64) -> (f64, f64) {
    (((low - ROUNDING - angle) / TAU).ceil(), ((high + ROUNDING - angle) / TAU).floor())
}

#[inline]
fn winding(range: [f64; 2], given: SplitAngle, near: Option<f64>) -> Winding {
    let SplitAngle { remainder: angle, turns } = given;
    // Nearly always the given value is in the range.
    if near.is_none() && turns == 0.0 && angle >= range[0] && angle <= range[1] {
        return Winding { turns, value: angle + TAU * turns };
    }
    nearest_winding(range, given, near)
}

fn nearest_winding(
    range: [f64; 2],
    SplitAngle { remainder: angle, turns }: SplitAngle,
    near: Option<f64>,
) -> Winding {
    // Of two values half a turn away, the greater one.
    let nearest = |target: f64| ((target - angle) / TAU + 0.5 + TIE).floor();
    let (first, last) = admissible_turns(range, angle);
    let admissible = first <= last;
    let turns = match near {
        _ if !admissible => nearest(0.0),
        Some(near) => nearest(near).clamp(first, last),
        None if (first..=last).contains(&turns) => turns,
        None => nearest(0.0).clamp(first, last),
    };
    let value = angle + TAU * turns;
    let [low, high] = range;
    let within = if admissible && turns != 0.0 { value.clamp(low, high) } else { value };
    Winding { turns, value: within }
}
