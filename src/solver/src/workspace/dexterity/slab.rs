//! Computation of some layers of the grid, independent of the others.

use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::super::observer::{Observer, go_on};
use super::super::request::WorkspaceError;
use super::crossings::{Sections, crossings};
use super::orientations::at;
use super::section::{Piece, Setting};
use super::{DexterityRequest, Grid};
use crate::machine::Machine;
use crate::pose::Point;

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

/// The crossing of a grid edge with a region's surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Seven times the number of the node where the edge begins, plus the edge's direction.
    pub edge: u64,
    /// Its position in the part frame, mm.
    pub at: Point,
}

/// A row of nodes along Z: their intervals, and whether each is in the reachable and in the dexterous region.
pub(super) struct Row {
    pub(super) counts: Vec<u8>,
    pub(super) intervals: Vec<[f64; 2]>,
    pub(super) inside: Vec<[bool; 2]>,
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
/// let request = DexterityRequest {
///     tool_length: 150.0,
///     table_clearance: None,
///     tool_radius: 0.0,
///     phi2: 0.0,
///     phi1: [-0.5, 0.5],
///     cell: 200.0,
/// };
/// let machine = Machine::verne();
/// let grid = Grid::new(&machine, &request, &Unobserved)?;
/// let part = slab(&machine, &request, &grid, 0..2, &Unobserved)?;
/// assert_eq!(part.counts.len(), 2 * (grid.counts[1] * grid.counts[2]) as usize);
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
    go_on(observer)?;
    let setting = Setting::new(machine, request);
    let layers = layers.start.min(grid.counts[0])..layers.end.min(grid.counts[0]);
    // The edges of the last layer end at the next.
    let looked_at = layers.start..(layers.end + 1).min(grid.counts[0]);
    let work = Work { setting: &setting, request, grid, observer };
    let done = Done { count: AtomicUsize::new(0), whole: 3 * looked_at.len(), observer };
    let sections: Vec<Vec<Piece>> = looked_at
        .clone()
        .into_par_iter()
        .map(|layer| {
            go_on(observer)?;
            Ok(setting.section(grid.node([layer, 0, 0])[0]))
        })
        .collect::<Result<_, WorkspaceError>>()?;
    let mut slab = Slab { layers: layers.clone(), ..Slab::default() };
    let mut before: Option<Vec<Row>> = None;
    for (layer, section) in looked_at.zip(&sections) {
        go_on(observer)?;
        let rows = work.layer(layer, section)?;
        done.one(2);
        if layers.contains(&layer) {
            for row in &rows {
                slab.counts.extend(&row.counts);
                slab.intervals.extend(&row.intervals);
            }
        }
        if let Some(first) = before {
            let sections =
                Sections::new(&setting, grid, layer - 1, &sections[(layer - 1 - layers.start) as usize]);
            let found = crossings(&work, &sections, layer - 1, [&first, &rows])?;
            for (all, found) in slab.crossings.iter_mut().zip(found) {
                all.extend(found);
            }
            done.one(1);
        }
        before = Some(rows);
    }
    Ok(slab)
}

/// Progress through the layers. The nodes of a layer are twice as much work as its edges.
struct Done<'a> {
    count: AtomicUsize,
    whole: usize,
    observer: &'a dyn Observer,
}

impl Done<'_> {
    fn one(&self, parts: usize) {
        let done = self.count.fetch_add(parts, Ordering::Relaxed) + parts;
        self.observer.progress(super::ratio(done, self.whole));
    }
}

/// The input of a slab's computation.
pub(super) struct Work<'a> {
    pub(super) setting: &'a Setting<'a>,
    pub(super) request: &'a DexterityRequest,
    pub(super) grid: &'a Grid,
    pub(super) observer: &'a dyn Observer,
}

impl Work<'_> {
    fn layer(&self, layer: u32, section: &[Piece]) -> Result<Vec<Row>, WorkspaceError> {
        let [_, across, up] = self.grid.counts;
        (0..across)
            .into_par_iter()
            .map(|j| {
                let mut row = Row { counts: Vec::new(), intervals: Vec::new(), inside: Vec::new() };
                for k in 0..up {
                    go_on(self.observer)?;
                    self.node([layer, j, k], section, &mut row);
                }
                Ok(row)
            })
            .collect()
    }

    fn node(&self, number: [u32; 3], section: &[Piece], row: &mut Row) {
        let [_, v1, z] = self.grid.node(number);
        let found = at(self.setting, section, [v1, z], self.request.phi1);
        let count = u8::try_from(found.len()).unwrap_or(u8::MAX);
        row.counts.push(count);
        row.intervals.extend(found.iter().take(usize::from(count)).map(|interval| interval.ends));
        let inside = self.inside(&row.intervals[row.intervals.len() - usize::from(count)..]);
        row.inside.push(inside.map(|inside| inside && !self.grid.outermost(number)));
    }

    /// Whether a point with these intervals is reachable, and whether it is dexterous.
    pub(super) fn inside(&self, intervals: &[[f64; 2]]) -> [bool; 2] {
        [!intervals.is_empty(), intervals == [self.request.phi1]]
    }
}
