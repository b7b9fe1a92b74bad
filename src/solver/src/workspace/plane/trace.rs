//! The traversal of the domain: all squares of a lattice, on several threads.

use rayon::prelude::*;

use super::lattice::Lattice;
use super::mesh::PlaneMesh;
use super::patch::Patch;
use super::refinement::Refinement;
use super::sample::Sample;
use super::weld::weld;
use crate::workspace::cover::{Cover, Rectangle};
use crate::workspace::domain::Domain;
use crate::workspace::observer::{Observer, ProgressCounter, StepCounter, Subprogress};
use crate::workspace::request::WorkspaceError;

/// Numbers of squares along the longer side of the domain's rectangle. They are tried in turn until the result
/// closes.
pub(in crate::workspace) const LATTICES: [u32; 3] = [12, 24, 29];
/// Margin between the domain and the lattice's border, as a fraction of the lattice.
const BORDER: f64 = 0.017;
/// Fraction of the work that is done when all squares are cut.
const CUT: f64 = 0.9;

impl PlaneMesh {
    /// Traces the domain on a lattice, within the tolerance. It is an error if a surface over it would have more than
    /// `most` triangles.
    pub(in crate::workspace) fn trace(
        domain: &Domain<'_>,
        cover: &Cover,
        squares: u32,
        tolerance: f64,
        most: usize,
        observer: &dyn Observer,
    ) -> Result<Self, WorkspaceError> {
        let Some(rectangle) = cover.bounds() else { return Ok(Self::default()) };
        let lattice = Lattice::new(with_border(rectangle), squares);
        let refinement = Refinement::new(domain, cover, tolerance, most, observer);
        let cutting = Subprogress::new(observer, 0.0, CUT);
        let progress = ProgressCounter::new(&cutting, lattice.count());
        let patches: Result<Vec<Patch>, WorkspaceError> = (0..lattice.count())
            .into_par_iter()
            .map(|number| {
                let patch = square(&refinement, lattice.corners(number))?;
                progress.finished(1);
                Ok(patch)
            })
            .collect();
        weld(domain, &lattice, patches?, &mut StepCounter::new(observer))
    }
}

/// A larger rectangle: no limit ends the domain on the lattice's border.
fn with_border([low, high]: Rectangle) -> Rectangle {
    let border = BORDER * (high[0] - low[0]).max(high[1] - low[1]);
    [low.map(|end| end - border), high.map(|end| end + border)]
}

/// One square's triangles.
fn square(refinement: &Refinement<'_>, corners: [[f64; 2]; 4]) -> Result<Patch, WorkspaceError> {
    let mut patch = Patch::default();
    let [a, b, c, d] = corners.map(|at| Sample::new(refinement.domain, at));
    refinement.triangle([&a, &b, &c], &mut patch)?;
    refinement.triangle([&a, &c, &d], &mut patch)?;
    patch.finish();
    Ok(patch)
}
