//! The surface and the volume of the region of origins.

use super::nodes::OriginSlab;
use crate::pose::Point;
use crate::workspace::dexterity::{Grid, triangles};
use crate::workspace::{Observer, WorkspaceError};

/// The region of origins.
///
/// Its surface consists of cuts through the six tetrahedra around the diagonals of the grid's cubes. It is closed and a
/// manifold. Its vertices lie on edges of the tetrahedra, less than 1/2000 of an edge from the true surface of the
/// places that were examined. A component that is smaller than a cell may be missing.
#[derive(Clone, Debug, PartialEq)]
pub struct OriginRegion {
    /// Vertices of the surface, mm.
    pub positions: Vec<Point>,
    /// Vertex numbers of each triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

/// Joins slabs that cover the grid, in any order, to the region.
///
/// # Units
///
/// Millimetres.
///
/// # Errors
///
/// - [`WorkspaceError::Open`]: a layer is missing or given twice, or the surface could not be closed.
/// - [`WorkspaceError::Cancelled`]: the observer asked to stop.
pub fn merge_origins(
    grid: &Grid,
    mut slabs: Vec<OriginSlab>,
    observer: &dyn Observer,
) -> Result<OriginRegion, WorkspaceError> {
    slabs.sort_by_key(|slab| slab.layers.start);
    let ends = slabs.iter().map(|slab| slab.layers.end);
    let starts = slabs.iter().map(|slab| slab.layers.start);
    if !std::iter::once(0).chain(ends).eq(starts.chain([grid.counts[0]])) {
        return Err(WorkspaceError::Open);
    }
    let (mut inside, mut crossings) = (Vec::new(), Vec::new());
    for slab in slabs {
        inside.extend(slab.inside);
        crossings.extend(slab.crossings);
    }
    let triangles = triangles(grid, &inside, &crossings, observer)?;
    Ok(OriginRegion { positions: crossings.iter().map(|crossing| crossing.at).collect(), triangles })
}

/// The volume of the region and its error, mm³, from its surface on a grid and on one with twice the step.
///
/// The volume within a surface of triangles is off by the square of the step. So a third of the difference is added,
/// and twice that is the error: an estimate, not a bound.
pub fn origin_volume(fine: &OriginRegion, coarse: &OriginRegion) -> [f64; 2] {
    let volume = fine.volume();
    let correction = (volume - coarse.volume()) / 3.0;
    [volume + correction, 2.0 * correction.abs() + 1e-9 * volume]
}

impl OriginRegion {
    /// The volume that the surface encloses.
    ///
    /// # Units
    ///
    /// mm³.
    pub fn volume(&self) -> f64 {
        let Some(from) = self.positions.first() else { return 0.0 };
        let corner = |number: u32| -> Point {
            let at = self.positions[number as usize];
            std::array::from_fn(|i| at[i] - from[i])
        };
        let of = |corners: &[u32; 3]| {
            let [[a, b, c], [d, e, f], [g, h, i]] = corners.map(corner);
            (a * (e * i - f * h) + b * (f * g - d * i) + c * (d * h - e * g)) / 6.0
        };
        self.triangles.iter().map(of).sum()
    }
}
