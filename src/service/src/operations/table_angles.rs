//! The table's angles of a solution, on the winding that is nearest to where the table stands.

use std::f64::consts::PI;

use verne_solver::{Machine, PartPose, SplitAngle, TableAngles, table_windings};

use crate::wire::degrees::{from_degrees, from_degrees_of_turn, to_degrees, whole_turns};
use crate::wire::request::Near;

/// A tool orientation, by angles of at most half a turn and whole turns.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Orientation {
    phi1: SplitAngle,
    phi2: SplitAngle,
}

/// The table's angles: as the solver uses them, and as they are answered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stand {
    pub(crate) angles: TableAngles,
    /// theta1 and theta2 in degrees. Whole turns are added in degrees, which adds no rounding.
    pub(crate) degrees: [f64; 2],
}

impl Stand {
    /// The angles that a request gives.
    pub(crate) fn given(degrees: [f64; 2]) -> Self {
        let [theta1, theta2] = degrees.map(from_degrees);
        Self { angles: TableAngles { theta1, theta2 }, degrees }
    }
}

impl Orientation {
    /// From degrees.
    pub(crate) fn of_degrees(degrees: [f64; 2]) -> Self {
        let [phi1, phi2] = degrees.map(wound);
        Self { phi1, phi2 }
    }

    /// From radians that may stem from degrees.
    pub(crate) fn of_radians(radians: [f64; 2]) -> Self {
        let [phi1, phi2] = radians.map(|radians| {
            if radians.abs() <= PI {
                SplitAngle { remainder: radians, turns: 0.0 }
            } else {
                wound(to_degrees(radians))
            }
        });
        Self { phi1, phi2 }
    }

    /// The tool's pose at a point of the table frame.
    pub(crate) fn at(&self, [x, y, z]: [f64; 3]) -> PartPose {
        PartPose { x, y, z, phi1: self.phi1.remainder, phi2: self.phi2.remainder }
    }

    /// The table's angles that go with a platform angle: on the windings within the table's
    /// ranges that are nearest to `near`, or else on those asked for.
    pub(crate) fn stand(&self, machine: &Machine, alpha: f64, near: Option<&Near>) -> Stand {
        let asked = [
            SplitAngle { remainder: alpha - self.phi1.remainder, turns: -self.phi1.turns },
            SplitAngle { remainder: -self.phi2.remainder, turns: -self.phi2.turns },
        ];
        let near = match near {
            Some(Near::Joints(joints)) => [joints.theta1, joints.theta2].map(|theta| theta.map(from_degrees)),
            _ => [None; 2],
        };
        let wound = table_windings(machine, asked, near);
        let [theta1, theta2] = wound.map(|wound| wound.value);
        let degrees = std::array::from_fn(|i| to_degrees(asked[i].remainder) + 360.0 * wound[i].turns);
        Stand { angles: TableAngles { theta1, theta2 }, degrees }
    }
}

fn wound(degrees: f64) -> SplitAngle {
    SplitAngle { remainder: from_degrees_of_turn(degrees), turns: whole_turns(degrees) }
}
