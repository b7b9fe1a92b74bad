//! The plane domain as triangles, or as the sides of its boundary.
//!
//! A lattice of squares, two triangles each, is refined and cut. Each square is independent of the others, so threads
//! share the work and the result does not depend on their number.

mod bend;
mod ears;
mod join;
mod leaf;
mod patch;
mod refine;
mod site;
mod thin;

use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::cover::{Cover, Rectangle};
use super::domain::Domain;
use super::observer::{Observer, Pace};
use super::request::WorkspaceError;
use patch::Patch;
pub(super) use patch::{Rim, Triangle, Vertex};
use refine::Refinement;
use site::Site;

/// Numbers of squares along the longer side of the domain's rectangle. They are tried in turn until the result
/// closes.
pub(super) const ATTEMPTS: [u32; 3] = [12, 24, 29];
/// Margin between the domain and the lattice's border, as a fraction of the lattice.
const BORDER: f64 = 0.017;

/// The triangles of the domain, and the sides of its boundary with the domain to their left.
pub(super) struct Plane {
    pub(super) vertices: Vec<Vertex>,
    pub(super) triangles: Vec<Triangle>,
    pub(super) rims: Vec<Rim>,
}

impl Plane {
    /// Traces the domain on a lattice, within the tolerance. It is an error if a surface over it would have more than
    /// `most` triangles.
    pub(super) fn trace(
        domain: &Domain<'_>,
        cover: &Cover,
        squares: u32,
        tolerance: f64,
        most: usize,
        observer: &dyn Observer,
    ) -> Result<Self, WorkspaceError> {
        let Some(rectangle) = cover.bounds() else {
            return Ok(Self { vertices: Vec::new(), triangles: Vec::new(), rims: Vec::new() });
        };
        let lattice = Lattice::new(with_border(rectangle), squares);
        let (count, done, made) = (lattice.count(), AtomicUsize::new(0), AtomicUsize::new(0));
        let refinement = Refinement { domain, cover, tolerance, most, made: &made, observer };
        let patches: Result<Vec<Patch>, WorkspaceError> = (0..count)
            .into_par_iter()
            .map(|number| {
                let patch = square(&refinement, lattice.corners(number))?;
                let done = done.fetch_add(1, Ordering::Relaxed) + 1;
                observer.progress(0.9 * ratio(done, count));
                Ok(patch)
            })
            .collect();
        join::join(domain, &lattice, patches?, &mut Pace::new(observer))
    }

    /// Triangles of a surface over it: two sheets, and two for each side's wall.
    pub(super) fn surface_triangles(&self) -> usize {
        2 * (self.triangles.len() + self.rims.len())
    }

    /// Whether the sides are closed rings.
    pub(super) fn closes(&self) -> bool {
        let mut balance = vec![0_i32; self.vertices.len()];
        for [from, to] in self.rims.iter().map(|rim| rim.ends) {
            balance[from as usize] += 1;
            balance[to as usize] -= 1;
        }
        balance.into_iter().all(|difference| difference == 0)
    }
}

/// A larger rectangle: no limit ends the domain on the lattice's border.
fn with_border([low, high]: Rectangle) -> Rectangle {
    let border = BORDER * (high[0] - low[0]).max(high[1] - low[1]);
    [low.map(|end| end - border), high.map(|end| end + border)]
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
    fn new([low, high]: Rectangle, along: u32) -> Self {
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

    /// Whether a point lies on the lattice's lines, where it may belong to two squares.
    fn shared(&self, [x, y]: [f64; 2]) -> bool {
        self.lines[0].binary_search_by(|line| line.total_cmp(&x)).is_ok()
            || self.lines[1].binary_search_by(|line| line.total_cmp(&y)).is_ok()
    }
}
