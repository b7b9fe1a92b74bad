//! The nodes of a grid's layers: their inclinations, and in which region they are.

use rayon::prelude::*;

use super::grid::Grid;
use super::monotone_piece::MonotonePiece;
use super::orientations::intervals_at;
use super::request::DexterityRequest;
use super::section::ToolWorkspace;
use crate::workspace::observer::{Observer, check_cancelled};
use crate::workspace::request::WorkspaceError;

/// A row of nodes along Z: their intervals, and whether each is in the reachable and in the dexterous region.
pub(super) struct Row {
    pub(super) counts: Vec<u8>,
    pub(super) intervals: Vec<[f64; 2]>,
    pub(super) inside: Vec<[bool; 2]>,
}

/// The input of a map's computation.
pub(super) struct MapInput<'a> {
    pub(super) tool: &'a ToolWorkspace<'a>,
    pub(super) request: &'a DexterityRequest,
    pub(super) grid: &'a Grid,
    pub(super) observer: &'a dyn Observer,
}

impl MapInput<'_> {
    pub(super) fn layer(&self, layer: u32, section: &[MonotonePiece]) -> Result<Vec<Row>, WorkspaceError> {
        let [_, across, up] = self.grid.counts;
        (0..across)
            .into_par_iter()
            .map(|j| {
                let mut row = Row { counts: Vec::new(), intervals: Vec::new(), inside: Vec::new() };
                for k in 0..up {
                    check_cancelled(self.observer)?;
                    self.node([layer, j, k], section, &mut row)?;
                }
                Ok(row)
            })
            .collect()
    }

    fn node(&self, number: [u32; 3], section: &[MonotonePiece], row: &mut Row) -> Result<(), WorkspaceError> {
        let [_, v1, z] = self.grid.node(number);
        let found = intervals_at(self.tool, section, [v1, z], self.request.phi1);
        row.counts.push(counted(found.len())?);
        row.intervals.extend(found.iter().map(|interval| interval.ends));
        let inside = self.inside(&row.intervals[row.intervals.len() - found.len()..]);
        row.inside.push(inside.map(|inside| inside && !self.grid.outermost(number)));
        Ok(())
    }

    /// Whether a point with these intervals is reachable, and whether it is dexterous.
    pub(super) fn inside(&self, intervals: &[[f64; 2]]) -> [bool; 2] {
        [!intervals.is_empty(), intervals == [self.request.phi1]]
    }
}

/// The number of a node's intervals, as a slab stores it.
fn counted(intervals: usize) -> Result<u8, WorkspaceError> {
    u8::try_from(intervals).map_err(|_| WorkspaceError::TooManyIntervals { intervals })
}

#[cfg(test)]
mod tests {
    use super::counted;
    use crate::workspace::request::WorkspaceError;

    #[test]
    fn no_interval_is_dropped() {
        assert_eq!([counted(0), counted(255)], [Ok(0), Ok(255)]);
        assert_eq!(counted(256), Err(WorkspaceError::TooManyIntervals { intervals: 256 }));
    }
}
