//! The estimated work of a tool path.

use verne_program::Step;

use crate::operations::program_motions::ProgramMotions;
use crate::wire::toolpath::Tolerance;

/// About the seconds of one core that a row takes.
const ROW_COST: f64 = 3e-5;

/// About the distance of rows, mm, at the tolerance that follows, mm. It grows with the root of the tolerance.
const ROW_DISTANCE: f64 = 7.0;
const AT_TOLERANCE: f64 = 0.01;

/// Estimates the work, seconds of one core, from the number of moves and the length of the paths.
pub(crate) fn toolpath_cost(motions: &ProgramMotions, tolerance: &Tolerance) -> f64 {
    let distance = ROW_DISTANCE * (tolerance.tip / AT_TOLERANCE).sqrt();
    let rows = motions.program().steps().map(|step| match step {
        Step::Move(segment) => 1.0 + segment.length() / distance,
        Step::Event(_) => 0.0,
    });
    ROW_COST * rows.sum::<f64>()
}
