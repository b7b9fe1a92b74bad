//! Joining of slabs to one dexterity map.

use super::crossings::Crossing;
use super::grid::Grid;
use super::region::{Region, triangles};
use super::request::DexterityRequest;
use super::slab::Slab;
use crate::workspace::measure::Volume;
use crate::workspace::observer::{Observer, StepCounter};
use crate::workspace::request::WorkspaceError;

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

/// Joins slabs that cover the grid, in any order, and the two volumes to the answer of
/// [`dexterity`](super::dexterity()).
///
/// # Units
///
/// Millimetres, mm³ and radians.
///
/// # Errors
///
/// - [`WorkspaceError::Open`]: a layer is missing or given twice, or a region's surface could not be closed.
/// - [`WorkspaceError::TooFine`]: there are more intervals than 32 bits can number.
/// - [`WorkspaceError::Cancelled`]: the observer asked to stop.
///
/// # Examples
///
/// ```
/// use verne_solver::Machine;
/// use verne_solver::workspace::dexterity::{DexterityRequest, Grid, merge, slab};
/// use verne_solver::workspace::{Unobserved, Volume, WorkspaceError};
///
/// let request = DexterityRequest { tool_length: 150.0, ..DexterityRequest::new([-0.5, 0.5], 200.0) };
/// let machine = Machine::verne();
/// let grid = Grid::new(&machine, &request, &Unobserved)?;
/// let slab = |layers| slab(&machine, &request, &grid, layers, &Unobserved);
/// let volumes = [Volume::Value { value: 0.0, error: 0.0 }; 2]; // in place of those that `volumes` computes
/// let join = |slabs| merge(&request, &grid, slabs, volumes, &Unobserved);
/// let two = join(vec![slab(2..grid.counts[0])?, slab(0..2)?])?;
/// assert_eq!(two, join(vec![slab(0..grid.counts[0])?])?);
/// assert_eq!(join(vec![slab(0..2)?]), Err(WorkspaceError::Open), "layers are missing");
/// # Ok::<(), WorkspaceError>(())
/// ```
pub fn merge(
    request: &DexterityRequest,
    grid: &Grid,
    mut slabs: Vec<Slab>,
    volumes: [Volume; 2],
    observer: &dyn Observer,
) -> Result<Dexterity, WorkspaceError> {
    slabs.sort_by_key(|slab| slab.layers.start);
    let ends = slabs.iter().map(|slab| slab.layers.end);
    let starts = slabs.iter().map(|slab| slab.layers.start);
    let complete = std::iter::once(0).chain(ends).eq(starts.chain([grid.counts[0]]));
    if !complete {
        return Err(WorkspaceError::Open);
    }
    let (mut offsets, mut intervals, mut inside) = (vec![0], Vec::new(), [Vec::new(), Vec::new()]);
    let mut crossings: [Vec<Crossing>; 2] = [Vec::new(), Vec::new()];
    let mut steps = StepCounter::new(observer);
    for slab in slabs {
        let mut from = 0;
        for &count in &slab.counts {
            steps.step()?;
            let found = &slab.intervals[from..from + usize::from(count)];
            from += found.len();
            intervals.extend(found);
            offsets.push(u32::try_from(intervals.len()).map_err(|_| WorkspaceError::TooFine)?);
            let outermost = grid.outermost(position(grid, inside[0].len()));
            inside[0].push(!found.is_empty() && !outermost);
            inside[1].push(found == [request.phi1] && !outermost);
        }
        for (all, found) in crossings.iter_mut().zip(slab.crossings) {
            all.extend(found);
        }
    }
    let region = |n: usize| {
        let triangles = triangles(grid, &inside[n], &crossings[n], observer)?;
        let positions = crossings[n].iter().map(|crossing| crossing.at).collect();
        Ok(Region { volume: volumes[n], positions, triangles })
    };
    let (reachable, dexterous) = (region(0)?, region(1)?);
    Ok(Dexterity { grid: *grid, offsets, intervals, reachable, dexterous })
}

/// The grid position of a node, from its number.
fn position(grid: &Grid, number: usize) -> [u32; 3] {
    let [_, across, up] = grid.counts.map(|count| count as usize);
    [number / up / across, number / up % across, number % up].map(|n| u32::try_from(n).unwrap_or(u32::MAX))
}
