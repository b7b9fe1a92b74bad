//! The plane domain as triangles, or as the sides of its boundary.
//!
//! A lattice of squares, two triangles each, is refined and cut; every square on its own, so that
//! threads share the work and the result does not depend on them.

mod bend;
mod ears;
mod join;
mod leaf;
mod patch;
mod refine;
mod site;

use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::domain::{Domain, LIMITS};
use super::observer::Observer;
use super::request::WorkspaceError;
pub(super) use patch::{Rim, Triangle, Vertex};
use patch::Patch;
use refine::Refinement;
use site::Site;

/// Squares along the rectangle in which the domain is looked for, and along the one it is then
/// known to lie in.
const COARSE: u32 = 24;
const SQUARES: u32 = 12;

/// The domain's triangles and its sides, the domain to their left.
pub(super) struct Plane {
    pub(super) vertices: Vec<Vertex>,
    pub(super) triangles: Vec<Triangle>,
    pub(super) rims: Vec<Rim>,
}

impl Plane {
    pub(super) fn trace(
        domain: &Domain<'_>,
        tolerance: f64,
        observer: &dyn Observer,
    ) -> Result<Self, WorkspaceError> {
        if domain.empty {
            return Ok(Self { vertices: Vec::new(), triangles: Vec::new(), rims: Vec::new() });
        }
        let Some(rectangle) = narrowed(domain) else {
            return Ok(Self { vertices: Vec::new(), triangles: Vec::new(), rims: Vec::new() });
        };
        let lattice = Lattice::new(rectangle, SQUARES);
        let refinement = Refinement { domain, tolerance, observer };
        let (count, done) = (lattice.count(), AtomicUsize::new(0));
        let patches: Result<Vec<Patch>, WorkspaceError> = (0..count)
            .into_par_iter()
            .map(|number| {
                let patch = square(&refinement, lattice.corners(number))?;
                let done = done.fetch_add(1, Ordering::Relaxed) + 1;
                observer.progress(0.9 * ratio(done, count));
                Ok(patch)
            })
            .collect();
        join::join(domain, &lattice, patches?)
    }
}

fn ratio(part: usize, whole: usize) -> f64 {
    let number = |n: usize| f64::from(u32::try_from(n).unwrap_or(u32::MAX));
    number(part) / number(whole)
}

/// One square's triangles.
fn square(refinement: &Refinement<'_>, corners: [[f64; 2]; 4]) -> Result<Patch, WorkspaceError> {
    let mut patch = Patch::default();
    let [a, b, c, d] = corners.map(|at| Site::new(refinement.domain, at));
    refinement.triangle([&a, &b, &c], &mut patch)?;
    refinement.triangle([&a, &c, &d], &mut patch)?;
    patch.forget();
    Ok(patch)
}

/// A lattice of rectangles as nearly square as whole numbers allow.
struct Lattice {
    /// Coordinates of its lines, along x and y.
    lines: [Vec<f64>; 2],
}

impl Lattice {
    fn new([low, high]: [[f64; 2]; 2], along: u32) -> Self {
        let sizes = [high[0] - low[0], high[1] - low[1]];
        let size = sizes[0].max(sizes[1]) / f64::from(along);
        let lines = [0, 1].map(|axis| {
            let count = (1..along).find(|&n| f64::from(n) * size >= 0.9 * sizes[axis]).unwrap_or(along);
            (0..=count).map(|n| low[axis] + sizes[axis] * (f64::from(n) / f64::from(count))).collect()
        });
        Self { lines }
    }

    fn count(&self) -> usize {
        (self.lines[0].len() - 1) * (self.lines[1].len() - 1)
    }

    /// Corners of a rectangle, counter-clockwise.
    fn corners(&self, number: usize) -> [[f64; 2]; 4] {
        let across = self.lines[0].len() - 1;
        let (i, j) = (number % across, number / across);
        let ([x0, x1], [y0, y1]) =
            ([self.lines[0][i], self.lines[0][i + 1]], [self.lines[1][j], self.lines[1][j + 1]]);
        [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]
    }

    /// Whether a point lies on the lattice's lines, where two squares may have it.
    fn shared(&self, [x, y]: [f64; 2]) -> bool {
        self.lines[0].binary_search_by(|line| line.total_cmp(&x)).is_ok()
            || self.lines[1].binary_search_by(|line| line.total_cmp(&y)).is_ok()
    }
}

/// The part of the rectangle outside which some limit is clearly not kept; `None` if nothing is
/// left.
fn narrowed(domain: &Domain<'_>) -> Option<[[f64; 2]; 2]> {
    let [low, high] = domain.rectangle();
    let lines = [0, 1].map(|axis| -> Vec<f64> {
        let step = (high[axis] - low[axis]) / f64::from(COARSE);
        (0..=COARSE).map(|n| low[axis] + f64::from(n) * step).collect()
    });
    let rows: Vec<Vec<_>> = lines[1]
        .iter()
        .map(|&y| lines[0].iter().map(|&x| domain.values(&domain.column([x, y]))).collect())
        .collect();
    let mut found: Option<[[f64; 2]; 2]> = None;
    for (j, pair) in rows.windows(2).enumerate() {
        for i in 0..lines[0].len() - 1 {
            let corners = [&pair[0][i], &pair[0][i + 1], &pair[1][i], &pair[1][i + 1]];
            let outside = (0..LIMITS).any(|limit| corners.iter().all(|values| values[limit] < 0.0));
            if !outside {
                // A neighbour of such a square may hold a piece of the domain as well.
                let (x, y) = ([i.saturating_sub(1), i + 2], [j.saturating_sub(1), j + 2]);
                let at = |axis: usize, n: usize| lines[axis][n.min(lines[axis].len() - 1)];
                let [a, b] = found.unwrap_or([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]]);
                found = Some([
                    [a[0].min(at(0, x[0])), a[1].min(at(1, y[0]))],
                    [b[0].max(at(0, x[1])), b[1].max(at(1, y[1]))],
                ]);
            }
        }
    }
    found
}
