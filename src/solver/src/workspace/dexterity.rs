//! Dexterity: the inclinations phi1 of the tool that reach a part point, for a given azimuth phi2 and tool length.
//!
//! At constant x of the platform, the table turns the part point on a circle about the tilting axis. The angle on the
//! circle determines theta1. The tool's workspace at this x is a plane region between graphs. Where the circle lies
//! in that region the tool reaches the point, with phi1 = alpha - theta1. The answer consists of intervals of that
//! angle, which end at zeros of the limits. Nothing is sampled in phi1. The height over the table's plane depends on
//! the part point and on phi1 alone; it excludes arcs of phi1 in closed form. The [workspace documentation](super)
//! derives all this.

mod arc;
mod crossings;
mod floor;
mod grid;
mod inclination;
mod merge;
mod monotone_piece;
mod nodes;
mod orientations;
mod reach_angles;
mod region;
mod request;
mod section;
mod slab;
mod volumes;

pub use crossings::Crossing;
pub(crate) use crossings::EDGES;
pub use grid::Grid;
pub use inclination::InclinationInterval;
pub use merge::{Dexterity, merge};
pub use orientations::orientations;
pub use region::Region;
pub(crate) use region::triangles;
pub use request::{DexterityRequest, MOST_NODES};
pub use slab::{Slab, slab};
pub use volumes::volumes;

use super::observer::{Observer, Subprogress};
use super::request::WorkspaceError;
use crate::machine::Machine;

/// Fraction of the work that the volumes take.
const BY_VOLUMES: f64 = 0.2;

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
/// - [`WorkspaceError::OutOfDomain`]: a number is not finite or beyond [`MAX_INPUT`](crate::MAX_INPUT), the range of
///   phi1 is not ordered or longer than a revolution, or the cell is below 0.1 mm.
/// - [`WorkspaceError::Cancelled`]: the observer asked to stop.
/// - [`WorkspaceError::TooManyNodes`]: the grid would have more nodes than [`MOST_NODES`].
/// - [`WorkspaceError::TooManyIntervals`]: a node is reached in more than 255 intervals.
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
/// let request = DexterityRequest { tool_length: 150.0, ..DexterityRequest::new([-0.5, 0.5], 200.0) };
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
    let volumes = volumes(machine, request, &Subprogress::new(observer, 0.0, BY_VOLUMES))?;
    let mapping = Subprogress::new(observer, BY_VOLUMES, 1.0);
    let slab = slab(machine, request, &grid, 0..grid.counts[0], &mapping)?;
    merge(request, &grid, vec![slab], volumes, observer)
}
