//! The surface and the volume of the region of origins.

use super::OriginSurvey;
use super::boundary_search::BoundarySearch;
use super::closed_surface::ClosedSurface;
use super::measured_error::measured_error;
use super::nodes::OriginSlab;
use super::refinement::Refinement;
use super::smoothing::smooth;
use crate::machine::Machine;
use crate::pose::Point;
use crate::workspace::dexterity::triangles;
use crate::workspace::vector::{length, normal};
use crate::workspace::{Observer, Subprogress, WorkspaceError};

/// How far from the surface the boundary is searched, and how far from it along each axis origins are examined, as
/// multiples of the grid's step.
const REACH: f64 = 2.0;
const AROUND: f64 = 0.5;
/// The distance by which vertices of the surface may be off the boundary, as a fraction of its tolerance.
const OF_VERTICES: f64 = 1.0 / 64.0;
/// Fraction of the work after which the surface is refined.
const REFINED: f64 = 0.8;

/// The region of origins.
///
/// Its surface is made of cuts through the six tetrahedra around the diagonals of the grid's cubes, which are divided
/// where they are far from the boundary. It is closed, and every edge belongs to two triangles. A piece of the region,
/// or a gap in it, that is narrower than a cell may be missing.
#[derive(Clone, Debug, PartialEq)]
pub struct OriginRegion {
    /// Vertices of the surface, mm.
    pub positions: Vec<Point>,
    /// Vertex numbers of each triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Greatest distance between the surface and the region's boundary, mm: one and a half times the greatest distance
    /// from the surface at which one of [`ORIGIN_SAMPLES`](super::ORIGIN_SAMPLES) origins is on the wrong side, and at
    /// least the distance at which the refinement of the surface ends. It is measured, not proved.
    pub error: f64,
}

/// Joins slabs that cover the grid, in any order, to the region, and divides its triangles where they are far from the
/// boundary.
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
    machine: &Machine,
    survey: &OriginSurvey,
    mut slabs: Vec<OriginSlab>,
    observer: &dyn Observer,
) -> Result<OriginRegion, WorkspaceError> {
    let grid = &survey.grid;
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
    let positions = crossings.iter().map(|crossing| crossing.at).collect();
    let membership = survey.membership(machine);
    let search = BoundarySearch {
        membership: &membership,
        reach: REACH * grid.step,
        step: survey.surface_tolerance(),
        precision: OF_VERTICES * survey.surface_tolerance(),
    };
    let part = |from, to| Subprogress::new(observer, from, to);
    let mut surface =
        Refinement { search: &search, tolerance: survey.surface_tolerance(), positions, triangles };
    smooth(&search, &mut surface.positions, &surface.triangles, observer)?;
    surface.run(&part(0.0, REFINED))?;
    let Refinement { positions, triangles, .. } = surface;
    if triangles.is_empty() {
        return Ok(OriginRegion { positions, triangles, error: 0.0 });
    }
    let closed = ClosedSurface::new(&positions, &triangles, grid.step);
    let measured = measured_error(&membership, &closed, AROUND * grid.step, &part(REFINED, 1.0))?;
    let error = measured.max(survey.surface_tolerance()) + survey.place_tolerance();
    Ok(OriginRegion { positions, triangles, error })
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

    /// By how much the volume differs at most from the region's, if the surface is within its error of the boundary.
    ///
    /// # Units
    ///
    /// mm³.
    pub fn volume_error(&self) -> f64 {
        let corners = |triangle: &[u32; 3]| triangle.map(|corner| self.positions[corner as usize]);
        let area: f64 = self.triangles.iter().map(|triangle| 0.5 * length(normal(corners(triangle)))).sum();
        area * self.error
    }
}
