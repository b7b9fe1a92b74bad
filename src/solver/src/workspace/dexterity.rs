//! Dexterity: the tool's inclinations phi1 with which a part point can be reached, at a given
//! azimuth phi2 and tool length.
//!
//! At a fixed x of the platform the table turns the part about its axis, and the tool centre point
//! U stays on a circle about that axis: with the radius of the part point, at an angle that says
//! theta1. Where the circle lies in the tool's workspace (a plane region at this x, exactly known)
//! the point is reached, with phi1 = alpha - theta1. All that follows are intervals of that angle,
//! cut at zeros of the limits: nothing is sampled in phi1. The height over the table of what is lowest
//! depends on the part point and on phi1 alone, and excludes arcs of phi1 in closed form.

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
use crate::limit::DOMAIN;
use crate::machine::Machine;

/// Which inclinations are asked of which tool, on how fine a grid. Lengths in mm, angles in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DexterityRequest {
    /// Tool length from P.
    pub tool_length: f64,
    /// Least height of the tool's end and the platform's joints over the table's plane; `None`: the
    /// machine's own, if it has one.
    pub table_clearance: Option<f64>,
    /// Radius of the tool's end, for the height over the table.
    pub tool_radius: f64,
    /// Azimuth of the tool in the table frame.
    pub phi2: f64,
    /// Inclinations of the tool in the table frame, `[from, to]`, at most a revolution apart.
    pub phi1: [f64; 2],
    /// Step of the grid.
    pub cell: f64,
}

/// Most nodes of a grid.
pub const MOST_NODES: f64 = 2e7;

/// The volumes' part of the work.
const BY_VOLUMES: f64 = 0.2;

/// Where a part can be machined with which inclinations.
#[derive(Clone, Debug, PartialEq)]
pub struct Dexterity {
    /// The nodes.
    pub grid: Grid,
    /// Node n's intervals are those from `offsets[n]` up to `offsets[n + 1]`.
    pub offsets: Vec<u32>,
    /// Intervals of phi1 within the asked range, `[from, to]`, rad, ascending.
    pub intervals: Vec<[f64; 2]>,
    /// What is reached with at least one inclination of the range.
    pub reachable: Region,
    /// What is reached with all of them.
    pub dexterous: Region,
}

/// Computes the intervals of phi1 at the nodes of a grid over all reachable points, and two regions: what some phi1 of
/// the
/// range reaches, and what every phi1 of the range reaches.
///
/// It is [`grid`](Grid::new), [`slab`] for all of the grid's layers, [`volumes`] and [`merge`]. The answer does not
/// depend
/// on how the grid is cut into slabs, nor on the number of threads.
///
/// # Units
///
/// Millimetres, mm³ and radians.
///
/// # Errors
///
/// - [`WorkspaceError::OutOfDomain`]: a number is not finite or beyond [`DOMAIN`], the range of phi1 is
///   not ordered or longer than a revolution, or the cell is below 0.1 mm.
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

/// A part of the work, watched as a part of the whole.
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
            ("tool_length", self.tool_length.abs() <= DOMAIN),
            ("table_clearance", self.table_clearance.is_none_or(|least| least.abs() <= DOMAIN)),
            ("tool_radius", self.tool_radius.abs() <= DOMAIN),
            ("phi2", self.phi2.abs() <= DOMAIN),
            ("phi1", from.abs() <= DOMAIN && to.abs() <= DOMAIN && turn),
            ("cell", (FINEST_CELL..=DOMAIN).contains(&self.cell)),
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
