//! Slabs made one.

use super::super::measure::Volume;
use super::super::observer::{Observer, Pace};
use super::super::request::WorkspaceError;
use super::region::{Region, triangles};
use super::slab::{Crossing, Slab};
use super::{Dexterity, DexterityRequest, Grid};

/// Slabs that cover the grid, in any order, and the volumes made the answer;
/// [`WorkspaceError::Open`] if a layer is missing or there twice.
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
    let whole = std::iter::once(0).chain(ends).eq(starts.chain([grid.counts[0]]));
    if !whole {
        return Err(WorkspaceError::Open);
    }
    let (mut offsets, mut intervals, mut inside) = (vec![0], Vec::new(), [Vec::new(), Vec::new()]);
    let mut crossings: [Vec<Crossing>; 2] = [Vec::new(), Vec::new()];
    let mut pace = Pace::new(observer);
    for slab in slabs {
        let mut from = 0;
        for &count in &slab.counts {
            pace.step()?;
            let found = &slab.intervals[from..from + usize::from(count)];
            from += found.len();
            intervals.extend(found);
            offsets.push(u32::try_from(intervals.len()).map_err(|_| WorkspaceError::TooFine)?);
            let outermost = grid.outermost(place(grid, inside[0].len()));
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

/// A node's place from its number.
fn place(grid: &Grid, number: usize) -> [u32; 3] {
    let [_, across, up] = grid.counts.map(|count| count as usize);
    [number / up / across, number / up % across, number % up].map(|n| u32::try_from(n).unwrap_or(u32::MAX))
}
