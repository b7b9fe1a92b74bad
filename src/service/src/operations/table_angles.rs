//! The table's angles that go with a solution, on the winding nearest to the requested table position.

use std::f64::consts::PI;

use verne_solver::{Machine, PartPose, SplitAngle, TableAngles, table_windings};

use crate::wire::degrees::{from_degrees, from_degrees_of_turn, to_degrees, whole_turns};
use crate::wire::request::Near;

/// The orientation of a tool in the part frame: each angle as at most half a turn and a number of whole turns.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ToolOrientation {
    phi1: SplitAngle,
    phi2: SplitAngle,
}

/// The table's angles in radians for the solver and in degrees for the answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TablePosition {
    pub(crate) angles: TableAngles,
    /// theta1 and theta2 in degrees. Whole turns are added in degrees, because that does not round.
    pub(crate) degrees: [f64; 2],
}

impl TablePosition {
    /// From theta1 and theta2 in degrees.
    pub(crate) fn of_degrees(degrees: [f64; 2]) -> Self {
        let [theta1, theta2] = degrees.map(from_degrees);
        Self { angles: TableAngles { theta1, theta2 }, degrees }
    }
}

impl ToolOrientation {
    /// From phi1 and phi2 in degrees.
    pub(crate) fn of_degrees(degrees: [f64; 2]) -> Self {
        let [phi1, phi2] = degrees.map(winding);
        Self { phi1, phi2 }
    }

    /// From phi1 and phi2 in radians. Larger angles were converted from degrees: their turns are counted in degrees.
    pub(crate) fn of_radians(radians: [f64; 2]) -> Self {
        let [phi1, phi2] = radians.map(|radians| {
            if radians.abs() <= PI {
                SplitAngle { remainder: radians, turns: 0.0 }
            } else {
                winding(to_degrees(radians))
            }
        });
        Self { phi1, phi2 }
    }

    /// The tool's pose at a point of the part frame, mm.
    pub(crate) fn at(&self, [x, y, z]: [f64; 3]) -> PartPose {
        PartPose { x, y, z, phi1: self.phi1.remainder, phi2: self.phi2.remainder }
    }

    /// The table's angles that go with a platform angle alpha, rad: on the windings within the table's ranges that are
    /// nearest to `near`. Without `near`, they are on the windings of this orientation.
    pub(crate) fn table(&self, machine: &Machine, alpha: f64, near: Option<&Near>) -> TablePosition {
        let requested = [
            SplitAngle { remainder: alpha - self.phi1.remainder, turns: -self.phi1.turns },
            SplitAngle { remainder: -self.phi2.remainder, turns: -self.phi2.turns },
        ];
        let near = match near {
            Some(Near::Joints(joints)) => [joints.theta1, joints.theta2].map(|theta| theta.map(from_degrees)),
            _ => [None; 2],
        };
        let wound = table_windings(machine, requested, near);
        let [theta1, theta2] = wound.map(|wound| wound.value);
        let degrees = std::array::from_fn(|i| to_degrees(requested[i].remainder) + 360.0 * wound[i].turns);
        TablePosition { angles: TableAngles { theta1, theta2 }, degrees }
    }
}

fn winding(degrees: f64) -> SplitAngle {
    SplitAngle { remainder: from_degrees_of_turn(degrees), turns: whole_turns(degrees) }
}
