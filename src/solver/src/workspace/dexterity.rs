//! Dexterity: the inclinations phi1 of the tool that reach a part point, for a given azimuth phi2 and tool length.
//!
//! At constant x of the platform, the table turns the part point on a circle about the tilting axis. The angle on the
//! circle determines theta1. The tool's workspace at this x is a plane region between graphs. Where the circle lies
//! in that region the tool reaches the point, with phi1 = alpha - theta1. The answer consists of intervals of that
//! angle, which end at zeros of the limits. Nothing is sampled in phi1. The height over the table's plane depends on
//! the part point and on phi1 alone; it excludes arcs of phi1 in closed form. The [workspace documentation](super)
//! derives all this.

mod angles;
mod arc;
mod crossings;
mod floor;
mod grid;
mod merge;
mod orientations;
mod region;
mod section;
mod slab;
mod volumes;

pub use grid::Grid;
pub use merge::merge;
pub use orientations::{Interval, orientations};
pub use region::Region;
pub use slab::{Crossing, Slab, slab};
pub use volumes::volumes;

use super::observer::Observer;
use super::request::WorkspaceError;
use crate::machine::Machine;
use crate::request_range::MAX_INPUT;

/// The request of a dexterity map: tool, range of inclinations, and grid. Lengths are millimetres, angles radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DexterityRequest {
    /// Tool length, measured from P.
    pub tool_length: f64,
    /// Least height of the tool's end and of the platform's joints over the table's plane. `None` means the machine's
    /// own value, if it has one.
    pub table_clearance: Option<f64>,
    /// Radius of the tool's end, for the height over the table's plane.
    pub tool_radius: f64,
    /// Azimuth of the tool in the part frame.
    pub phi2: f64,
    /// Range of inclinations in the part frame, `[from, to]`, at most a revolution apart.
    pub phi1: [f64; 2],
    /// Step of the grid.
    pub cell: f64,
}

/// Greatest number of nodes of a grid.
pub const MOST_NODES: f64 = 2e7;

/// Fraction of the work that the volumes take.
const BY_VOLUMES: f64 = 0.2;

/// A dexterity map: the inclinations at each node of a grid, and two regions.
#[derive(Clone, Debug, PartialEq)]
pub struct Dexterity {
    /// The grid.
    pub grid: Grid,
    /// The intervals of node n are those from `offsets[n]` up to `offsets[n + 1]`.
    pub offsets: Vec<u32>,
    /// Intervals of phi1 within the requested range, `[from, to]`, rad, ascending.
    pub intervals: Vec<[f64; 2]>,
    /// The points that at least one inclination of the range reaches.
    pub reachable: Region,
    /// The points that all inclinations of the range reach.
    pub dexterous: Region,
}

/// Computes the intervals of phi1 at the nodes of a grid over all reachable points, and two regions: what some phi1 of
/// the range reaches, and what every phi1 of the range reaches.
///
/// It is [`grid`](Grid::new), [`slab()`] for all of the grid's layers, [`volumes()`] and [`merge()`]. The answer does
/// not depend on how the grid is cut into slabs, nor on the number of threads.
///
/// # Units
///
/// Millimetres, mm³ and radians.
///
/// # Errors
///
/// - [`WorkspaceError::OutOfDomain`]: a number is not finite or beyond [`MAX_INPUT`], the range of phi1 is not ordered
///   or longer than a revolution, or the cell is below 0.1 mm.
/// - [`WorkspaceError::Cancelled`]: the observer asked to stop.
/// - [`WorkspaceError::TooManyNodes`]: the grid would have more nodes than [`MOST_NODES`].
/// - [`WorkspaceError::TooFine`]: there are more intervals than 32 bits can number.
/// - [`WorkspaceError::Open`]: a region's surface could not be closed.
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
/// use verne_solver::workspace::dexterity::{DexterityRequest, dexterity};
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
/// let map = dexterity(&machine, &request, &Unobserved)?;
/// assert_eq!(map.offsets.len(), map.grid.nodes() + 1);
/// assert!(map.intervals.iter().all(|[from, to]| -0.5 <= *from && from <= to && *to <= 0.5));
/// # Ok::<(), WorkspaceError>(())
/// ```
pub fn dexterity(
    machine: &Machine,
    request: &DexterityRequest,
    observer: &dyn Observer,
) -> Result<Dexterity, WorkspaceError> {
    let grid = Grid::new(machine, request, observer)?;
    let share = |from, to| Share { observer, from, to };
    let volumes = volumes(machine, request, &share(0.0, BY_VOLUMES))?;
    let whole = slab(machine, request, &grid, 0..grid.counts[0], &share(BY_VOLUMES, 1.0))?;
    merge(request, &grid, vec![whole], volumes, observer)
}

/// Reports the progress of a subtask as a fraction of the whole.
struct Share<'a> {
    observer: &'a dyn Observer,
    from: f64,
    to: f64,
}

impl Observer for Share<'_> {
    fn progress(&self, part: f64) {
        self.observer.progress(self.from + part * (self.to - self.from));
    }

    fn cancelled(&self) -> bool {
        self.observer.cancelled()
    }
}

impl DexterityRequest {
    pub(super) fn check(&self) -> Result<(), WorkspaceError> {
        let [from, to] = self.phi1;
        let turn = (0.0..=std::f64::consts::TAU).contains(&(to - from));
        let checks = [
            ("tool_length", self.tool_length.abs() <= MAX_INPUT),
            ("table_clearance", self.table_clearance.is_none_or(|least| least.abs() <= MAX_INPUT)),
            ("tool_radius", self.tool_radius.abs() <= MAX_INPUT),
            ("phi2", self.phi2.abs() <= MAX_INPUT),
            ("phi1", from.abs() <= MAX_INPUT && to.abs() <= MAX_INPUT && turn),
            ("cell", (FINEST_CELL..=MAX_INPUT).contains(&self.cell)),
        ];
        match checks.into_iter().find(|(_, holds)| !holds) {
            Some((field, _)) => Err(WorkspaceError::OutOfDomain { field }),
            None => Ok(()),
        }
    }
}

fn count(n: usize) -> f64 {
    f64::from(u32::try_from(n).unwrap_or(u32::MAX))
}

fn ratio(part: usize, whole: usize) -> f64 {
    count(part) / count(whole.max(1))
}

/// Least step of a grid, mm.
const FINEST_CELL: f64 = 0.1;
