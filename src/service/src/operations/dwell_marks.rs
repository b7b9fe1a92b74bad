//! The places of a tool path where the tool stands on the part while the table turns.

use verne_solver::toolpath::{RowKind, TimedRow, Way};

use crate::wire::degrees::to_degrees;
use crate::wire::dwell_mark::DwellMark;

/// Most marks that a report lists.
const MOST_MARKS: usize = 1_000;

/// Finds the marks in the rows as they come.
#[derive(Debug, Default)]
pub(crate) struct DwellMarks {
    /// The first marks, in order.
    pub list: Vec<DwellMark>,
    /// The number of all marks.
    pub count: u64,
    /// The motion of the last row, if it is a row of a turn.
    turning: Option<usize>,
}

impl DwellMarks {
    /// Takes the next row, of this line. A mark is a run of rows of kind `turn` in one motion.
    pub(crate) fn push(&mut self, timed: &TimedRow, line: u32) {
        let row = &timed.row;
        if row.kind != RowKind::Turn {
            self.turning = None;
            return;
        }
        if self.turning.replace(row.motion) != Some(row.motion) {
            self.count += 1;
            if self.list.len() < MOST_MARKS {
                let [x, y, z] = row.position.tip.map(|coordinate| coordinate + 0.0);
                self.list.push(DwellMark { line, x, y, z, angle: 0.0, duration: Some(0.0) });
            }
        }
        if self.count == self.list.len() as u64
            && let Some(mark) = self.list.last_mut()
        {
            mark.angle += row.way.map_or(0.0, |Way { angle, .. }| to_degrees(angle));
            mark.duration = mark.duration.zip(timed.duration).map(|(sum, duration)| sum + duration);
        }
    }
}
