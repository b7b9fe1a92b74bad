//! A row of a batch in frame `part`: the tool's end and axis, and the working solutions of both orientations with the
//! axis.

use std::f64::consts::PI;

use verne_solver::axis::{POLE, Preimages, preimages, tool_axis};
use verne_solver::{KinematicsError, Machine, Point, Posture, part_every_working};

use crate::operations::batch_rows::ROW_WITH_AXIS;
use crate::operations::table_angles::ToolOrientation;
use crate::wire::batch::Row;

/// The tool's end and axis in the part frame.
#[derive(Debug)]
pub(crate) struct PartRow {
    tip: Point,
    /// Tool axis, of length 1.
    pub(crate) axis: [f64; 3],
    orientations: Orientations,
}

/// The orientations that have the axis.
#[derive(Debug)]
enum Orientations {
    Two([ToolOrientation; 2]),
    /// The pole: phi1 is 0 or π, and phi2 is free.
    Free {
        phi1: f64,
    },
}

/// A working solution of a row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate {
    pub(crate) orientation: ToolOrientation,
    pub(crate) posture: Posture,
}

/// The working solutions of a row, or the reason why there is none.
pub(crate) type Candidates = Result<Vec<Candidate>, KinematicsError>;

impl PartRow {
    /// From the five or six numbers of a row.
    pub(crate) fn of_numbers(row: &Row) -> Result<Self, String> {
        let tip = [row[0], row[1], row[2]];
        let orientations = if row.len() == ROW_WITH_AXIS {
            match preimages([row[3], row[4], row[5]]) {
                Some(Preimages::Two(both)) => Orientations::Two(both.map(ToolOrientation::of_radians)),
                Some(Preimages::Free { phi1 }) => Orientations::Free { phi1 },
                None => return Err("the axis [i, j, k] must not be zero".to_owned()),
            }
        } else {
            Orientations::of_degrees([row[3], row[4]])
        };
        Ok(Self { tip, axis: orientations.axis(), orientations })
    }

    /// Whether the axis leaves phi2 free.
    pub(crate) fn is_pole(&self) -> bool {
        matches!(self.orientations, Orientations::Free { .. })
    }

    /// The working solutions of both orientations: of each that of `part_working` first, then by alpha. At the pole
    /// theta2 (rad) is the given one. Without a solution, the refusal is that of the first orientation.
    pub(crate) fn candidates(&self, machine: &Machine, tool_length: f64, theta2: f64) -> Candidates {
        match &self.orientations {
            Orientations::Free { phi1 } => {
                self.with(machine, tool_length, ToolOrientation::of_radians([*phi1, 0.0 - theta2]))
            }
            Orientations::Two([first, second]) => {
                let first = self.with(machine, tool_length, *first);
                match (first, self.with(machine, tool_length, *second)) {
                    (Ok(mut all), Ok(second)) => {
                        all.extend(second);
                        Ok(all)
                    }
                    (Ok(only), Err(_)) | (Err(_), Ok(only)) => Ok(only),
                    (Err(refusal), Err(_)) => Err(refusal),
                }
            }
        }
    }

    fn with(&self, machine: &Machine, tool_length: f64, orientation: ToolOrientation) -> Candidates {
        let mut found = part_every_working(machine, &orientation.at(self.tip), tool_length)?;
        if let Some(others) = found.get_mut(1..) {
            others.sort_by(|a, b| a.pose.alpha.total_cmp(&b.pose.alpha));
        }
        Ok(found.into_iter().map(|posture| Candidate { orientation, posture }).collect())
    }
}

impl Orientations {
    /// The given orientation and the other one with its axis. Half a turn is added in degrees, because that does not
    /// round.
    fn of_degrees([phi1, phi2]: [f64; 2]) -> Self {
        let given = ToolOrientation::of_degrees([phi1, phi2]);
        let (sin, cos) = given.inclination().sin_cos();
        if sin.abs() <= POLE * cos.abs() {
            return Self::Free { phi1: if cos > 0.0 { 0.0 } else { PI } };
        }
        let half_turn = if phi2 > 0.0 { -180.0 } else { 180.0 };
        Self::Two([given, ToolOrientation::of_degrees([0.0 - phi1, phi2 + half_turn])])
    }

    fn axis(&self) -> [f64; 3] {
        match self {
            Self::Two([first, _]) => first.axis(),
            Self::Free { phi1 } => tool_axis(*phi1, 0.0),
        }
    }
}
