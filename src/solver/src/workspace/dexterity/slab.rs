//! Computation of some layers of the grid, independent of the others.

use std::ops::Range;

use rayon::prelude::*;

use super::crossings::{Crossing, Sections, crossings};
use super::grid::Grid;
use super::monotone_piece::MonotonePiece;
use super::nodes::{MapInput, Row};
use super::request::DexterityRequest;
use super::section::ToolWorkspace;
use crate::machine::Machine;
use crate::workspace::observer::{Observer, ProgressCounter, check_cancelled};
use crate::workspace::request::WorkspaceError;

/// The nodes of some layers of a grid, and the crossings of the edges that begin at them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Slab {
    /// The layers along the grid's first axis.
    pub layers: Range<u32>,
    /// Number of intervals of each node.
    pub counts: Vec<u8>,
    /// The intervals of phi1 of all nodes, node by node, rad.
    pub intervals: Vec<[f64; 2]>,
    /// Crossings of edges with the surface of the reachable region and of the dexterous region, ascending by edge.
    pub crossings: [Vec<Crossing>; 2],
}

/// Computes some layers of a grid. A layer's result does not depend on which other layers belong to the slab. Layers
/// beyond the grid are left out.
///
/// # Units
///
/// Millimetres and radians.
///
/// # Errors
///
/// - [`WorkspaceError::OutOfDomain`]: a number is not finite or beyond [`MAX_INPUT`](crate::MAX_INPUT), the range of
///   phi1 is not ordered or longer than a revolution, or the cell is below 0.1 mm.
/// - [`WorkspaceError::TooManyIntervals`]: a node is reached in more than 255 intervals.
/// - [`WorkspaceError::Cancelled`]: the observer asked to stop.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (9), (14), (26), (27); the
/// intervals are derived in the [workspace documentation](crate::workspace).
///
/// # Examples
///
/// ```
/// use verne_solver::Machine;
/// use verne_solver::workspace::dexterity::{DexterityRequest, Grid, slab};
/// use verne_solver::workspace::{Unobserved, WorkspaceError};
///
/// let request = DexterityRequest { tool_length: 150.0, ..DexterityRequest::new([-0.5, 0.5], 200.0) };
/// let machine = Machine::verne();
/// let grid = Grid::new(&machine, &request, &Unobserved)?;
/// let slab = slab(&machine, &request, &grid, 0..2, &Unobserved)?;
/// assert_eq!(slab.counts.len(), 2 * (grid.counts[1] * grid.counts[2]) as usize);
/// # Ok::<(), WorkspaceError>(())
/// ```
pub fn slab(
    machine: &Machine,
    request: &DexterityRequest,
    grid: &Grid,
    layers: Range<u32>,
    observer: &dyn Observer,
) -> Result<Slab, WorkspaceError> {
    request.check()?;
    check_cancelled(observer)?;
    let tool = ToolWorkspace::new(machine, request);
    let layers = layers.start.min(grid.counts[0])..layers.end.min(grid.counts[0]);
    // The edges of the last layer end at the next.
    let examined = layers.start..(layers.end + 1).min(grid.counts[0]);
    let input = MapInput { tool: &tool, request, grid, observer };
    // The nodes of a layer are twice as much work as its edges.
    let progress = ProgressCounter::new(observer, 3 * examined.len());
    let sections: Vec<Vec<MonotonePiece>> = examined
        .clone()
        .into_par_iter()
        .map(|layer| {
            check_cancelled(observer)?;
            Ok(tool.section(grid.node([layer, 0, 0])[0]))
        })
        .collect::<Result<_, WorkspaceError>>()?;
    let mut slab = Slab { layers: layers.clone(), ..Slab::default() };
    let mut before: Option<Vec<Row>> = None;
    for (layer, section) in examined.zip(&sections) {
        check_cancelled(observer)?;
        let rows = input.layer(layer, section)?;
        progress.finished(2);
        if layers.contains(&layer) {
            for row in &rows {
                slab.counts.extend(&row.counts);
                slab.intervals.extend(&row.intervals);
            }
        }
        if let Some(first) = before {
            let sections =
                Sections::new(&tool, grid, layer - 1, &sections[(layer - 1 - layers.start) as usize]);
            let found = crossings(&input, &sections, layer - 1, [&first, &rows])?;
            for (all, found) in slab.crossings.iter_mut().zip(found) {
                all.extend(found);
            }
            progress.finished(1);
        }
        before = Some(rows);
    }
    Ok(slab)
}
