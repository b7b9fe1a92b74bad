//! The table's angles that go with a solution, on the winding nearest to the requested table position.

use std::f64::consts::PI;

use verne_solver::axis::tool_axis;
use verne_solver::{Machine, PartPose, SplitAngle, TableAngles, Winding, rotary_windings, table_windings};

use crate::wire::degrees::{from_degrees, to_degrees, whole_turns};
use crate::wire::request::Near;
use crate::wire::windings::Windings;

/// The orientation of a tool in the part frame: each angle as at most half a turn and a number of whole turns.
#[derive(Clone, Copy, Debug, PartialEq)]
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

    /// phi1 within half a turn of zero, rad.
    pub(crate) fn inclination(&self) -> f64 {
        self.phi1.remainder
    }

    /// The tool axis in the part frame, of length 1.
    pub(crate) fn axis(&self) -> [f64; 3] {
        tool_axis(self.phi1.remainder, self.phi2.remainder)
    }

    /// The table's angles that go with a platform angle alpha, rad: on the windings within the table's ranges that are
    /// nearest to `near`. Without `near`, they are on the windings of this orientation.
    pub(crate) fn table(&self, machine: &Machine, alpha: f64, near: Option<&Near>) -> TablePosition {
        let near = match near {
            Some(Near::Joints(joints)) => [joints.theta1, joints.theta2].map(|theta| theta.map(from_degrees)),
            _ => [None; 2],
        };
        self.wound(machine, alpha, near).into()
    }

    /// The same with the angles to be near to in radians: theta1 and theta2, each if it matters.
    pub(crate) fn wound(&self, machine: &Machine, alpha: f64, near: [Option<f64>; 2]) -> WoundTable {
        let requested = [
            SplitAngle { remainder: alpha - self.phi1.remainder, turns: -self.phi1.turns },
            SplitAngle { remainder: -self.phi2.remainder, turns: -self.phi2.turns },
        ];
        let windings = table_windings(machine, requested, near);
        WoundTable { remainders: requested.map(|angle| angle.remainder), windings }
    }

    /// How many values of theta2, by whole turns apart, are within the machine's range.
    pub(crate) fn windings(&self, machine: &Machine) -> Windings {
        rotary_windings(machine, -self.phi2.remainder).into()
    }
}

/// The table's angles on their windings. Only an answer needs them in degrees, and the conversion costs more than they
/// do.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WoundTable {
    /// theta1 and theta2 without whole turns, rad.
    remainders: [f64; 2],
    windings: [Winding; 2],
}

impl WoundTable {
    /// theta1 and theta2.
    pub(crate) fn angles(&self) -> TableAngles {
        let [theta1, theta2] = self.windings.map(|winding| winding.value);
        TableAngles { theta1, theta2 }
    }
}

impl From<WoundTable> for TablePosition {
    fn from(wound: WoundTable) -> Self {
        let degrees =
            std::array::from_fn(|i| to_degrees(wound.remainders[i]) + 360.0 * wound.windings[i].turns);
        Self { angles: wound.angles(), degrees }
    }
}

fn winding(degrees: f64) -> SplitAngle {
    let turns = whole_turns(degrees);
    SplitAngle { remainder: from_degrees(degrees - 360.0 * turns), turns }
}
