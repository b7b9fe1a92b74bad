//! Adaptive triangles: each is halved until it is simple and flat enough.

use std::sync::atomic::{AtomicUsize, Ordering};

use super::edge_criteria::EdgeDecision::{Halve, Keep};
use super::edge_criteria::{EdgeCriteria, length};
use super::patch::Patch;
use super::sample::Sample;
use super::triangle_cut::TriangleCut;
use crate::workspace::cover::Cover;
use crate::workspace::domain::Domain;
use crate::workspace::observer::Observer;
use crate::workspace::request::WorkspaceError;

/// Width of a triangle that is not refined any more, in units of the tolerance.
const THIN: f64 = 0.01;

pub(super) struct Refinement<'a> {
    pub(super) domain: &'a Domain<'a>,
    criteria: EdgeCriteria<'a>,
    /// Greatest number of triangles of a surface over the plane, and the number so far.
    most: usize,
    made: AtomicUsize,
    observer: &'a dyn Observer,
}

impl<'a> Refinement<'a> {
    pub(super) fn new(
        domain: &'a Domain<'a>,
        cover: &'a Cover,
        tolerance: f64,
        most: usize,
        observer: &'a dyn Observer,
    ) -> Self {
        let criteria = EdgeCriteria { domain, cover, tolerance };
        Self { domain, criteria, most, made: AtomicUsize::new(0), observer }
    }

    /// Cuts the triangle, counter-clockwise, into faces that go into the patch.
    pub(super) fn triangle(&self, corners: [&Sample; 3], patch: &mut Patch) -> Result<(), WorkspaceError> {
        let [a, b, c] = corners;
        if self.is_thin(corners) {
            return self.cut_thin(corners, patch);
        }
        let middles = [
            patch.middle(self.domain, a, b),
            patch.middle(self.domain, b, c),
            patch.middle(self.domain, c, a),
        ];
        let [ab, bc, ca] =
            [0, 1, 2].map(|i| self.criteria.decide(corners[i], &middles[i], corners[(i + 1) % 3]));
        let [m, n, o] = &middles;
        match (ab, bc, ca) {
            (Keep, Keep, Keep) => self.cut(corners, [const { Vec::new() }; 3], patch),
            (Halve, Keep, Keep) => self.two([a, b, c], m, patch),
            (Keep, Halve, Keep) => self.two([b, c, a], n, patch),
            (Keep, Keep, Halve) => self.two([c, a, b], o, patch),
            (Halve, Halve, Keep) => self.three([a, b, c], [m, n], patch),
            (Keep, Halve, Halve) => self.three([b, c, a], [n, o], patch),
            (Halve, Keep, Halve) => self.three([c, a, b], [o, m], patch),
            (Halve, Halve, Halve) => {
                for quarter in [[a, m, o], [m, b, n], [o, n, c], [m, n, o]] {
                    self.triangle(quarter, patch)?;
                }
                Ok(())
            }
        }
    }

    /// Whether a triangle is too thin to be refined. Near a point where a limit jumps, outside the domain, one of its
    /// edges may be kept however often the other two are halved.
    fn is_thin(&self, [a, b, c]: [&Sample; 3]) -> bool {
        let ([ax, ay], [bx, by], [cx, cy]) = (a.at(), b.at(), c.at());
        let area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
        let longest = length(a, b).max(length(b, c)).max(length(c, a));
        area.is_nan() || area <= THIN * self.criteria.tolerance * longest
    }

    /// Cuts a triangle as it is, with the points that its neighbours will have on its edges.
    fn cut_thin(&self, corners: [&Sample; 3], patch: &mut Patch) -> Result<(), WorkspaceError> {
        let points = [0, 1, 2].map(|i| {
            let mut points = Vec::new();
            self.divisions(corners[i], corners[(i + 1) % 3], &mut points);
            points
        });
        self.cut(corners, points, patch)
    }

    fn cut(
        &self,
        corners: [&Sample; 3],
        points: [Vec<Sample>; 3],
        patch: &mut Patch,
    ) -> Result<(), WorkspaceError> {
        let before = patch.mesh.surface_triangles();
        let mut cut = TriangleCut::new(self.domain, self.criteria.tolerance, self.observer, corners, points);
        cut.cut_all()?;
        cut.add_to(patch)?;
        let added = patch.mesh.surface_triangles() - before;
        if self.made.fetch_add(added, Ordering::Relaxed).saturating_add(added) > self.most {
            return Err(WorkspaceError::TooManyTriangles { most: self.most });
        }
        Ok(())
    }

    /// All points at which an edge is halved, in order.
    fn divisions(&self, a: &Sample, b: &Sample, points: &mut Vec<Sample>) {
        let ([ax, ay], [bx, by]) = (a.at(), b.at());
        let middle = Sample::new(self.domain, [0.5 * (ax + bx), 0.5 * (ay + by)]);
        if self.criteria.decide(a, &middle, b) == Halve {
            self.divisions(a, &middle, points);
            points.push(middle.clone());
            self.divisions(&middle, b, points);
        }
    }

    /// The first edge is halved.
    fn two(&self, [a, b, c]: [&Sample; 3], m: &Sample, patch: &mut Patch) -> Result<(), WorkspaceError> {
        self.triangle([a, m, c], patch)?;
        self.triangle([m, b, c], patch)
    }

    /// The first two edges are halved.
    fn three(
        &self,
        [a, b, c]: [&Sample; 3],
        [m, n]: [&Sample; 2],
        patch: &mut Patch,
    ) -> Result<(), WorkspaceError> {
        self.triangle([m, b, n], patch)?;
        if length(a, n) <= length(m, c) {
            self.triangle([a, m, n], patch)?;
            self.triangle([a, n, c], patch)
        } else {
            self.triangle([a, m, c], patch)?;
            self.triangle([m, n, c], patch)
        }
    }
}
