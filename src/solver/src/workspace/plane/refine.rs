//! Adaptive triangles: each is halved until it is simple and flat enough.
//!
//! The decision to halve an edge depends on that edge alone. So both triangles at it agree, and parts of the plane
//! can be refined in any order.

use std::sync::atomic::{AtomicUsize, Ordering};

use super::super::cover::Cover;
use super::super::domain::{Domain, LIMITS};
use super::super::observer::Observer;
use super::super::path::{Shape, control, shape};
use super::super::request::WorkspaceError;
use super::super::root;
use super::bend;
use super::leaf::Leaf;
use super::patch::Patch;
use super::site::{CREASES, CURVES, FLOOR, Site, value};
use crate::pose::Point;

/// Fraction of the tolerance by which an edge's midpoint may be off. Inside a triangle whose edges are all off by as
/// much, a paraboloid is off by 4/3 of it.
const FLAT: f64 = 0.7;
/// Shortest edge that is halved because a limit may vanish twice on it, and because a sheet is curved, in units of
/// the tolerance.
const SHORTEST: [f64; 2] = [1.0, 0.02];

/// Fraction of the tolerance by which a curve may cross an edge and come back, and by which slider 1 may bind between
/// the others.
const SHALLOW: f64 = 0.25;
/// Longest edge near which nothing is hidden, over the size of the boxes that it crosses.
const GRAIN: f64 = 2.0;
/// Step perpendicular to an edge for the gradient of a limit, in units of the edge.
const STEP: f64 = 1e-4;

/// Precision of the point where the binding changes between sliders 2 and 3, as a fraction of the edge.
const CHANGE: f64 = 1e-6;
/// Width of a triangle that is not refined any more, in units of the tolerance.
const THIN: f64 = 0.01;

/// Greatest number of chords that the wall over an edge may need if a limit crosses the edge. The time to cut a
/// triangle is quadratic in its number of points.
const CHORDS: f64 = 256.0;

/// The decision about an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Edge {
    Kept,
    Halved,
}

use Edge::{Halved, Kept};

pub(super) struct Refinement<'a> {
    pub(super) domain: &'a Domain<'a>,
    pub(super) cover: &'a Cover,
    pub(super) tolerance: f64,
    /// Greatest number of triangles of a surface over the plane, and the number so far.
    pub(super) most: usize,
    pub(super) made: &'a AtomicUsize,
    pub(super) observer: &'a dyn Observer,
}

impl Refinement<'_> {
    /// Cuts the triangle, counter-clockwise, into pieces that go into the patch.
    pub(super) fn triangle(&self, corners: [&Site; 3], patch: &mut Patch) -> Result<(), WorkspaceError> {
        let [a, b, c] = corners;
        if self.thin(corners) {
            return self.finish(corners, patch);
        }
        let middles = [
            patch.middle(self.domain, a, b),
            patch.middle(self.domain, b, c),
            patch.middle(self.domain, c, a),
        ];
        let [ab, bc, ca] = [0, 1, 2].map(|i| self.edge(corners[i], &middles[i], corners[(i + 1) % 3]));
        let [m, n, o] = &middles;
        match (ab, bc, ca) {
            (Kept, Kept, Kept) => self.cut(Leaf::new(self, corners), patch),
            (Halved, Kept, Kept) => self.two([a, b, c], m, patch),
            (Kept, Halved, Kept) => self.two([b, c, a], n, patch),
            (Kept, Kept, Halved) => self.two([c, a, b], o, patch),
            (Halved, Halved, Kept) => self.three([a, b, c], [m, n], patch),
            (Kept, Halved, Halved) => self.three([b, c, a], [n, o], patch),
            (Halved, Kept, Halved) => self.three([c, a, b], [o, m], patch),
            (Halved, Halved, Halved) => {
                for part in [[a, m, o], [m, b, n], [o, n, c], [m, n, o]] {
                    self.triangle(part, patch)?;
                }
                Ok(())
            }
        }
    }

    /// Whether a triangle is too thin to be refined. Near a point where a limit jumps, outside the domain, one of its
    /// edges may be kept however often the other two are halved.
    fn thin(&self, [a, b, c]: [&Site; 3]) -> bool {
        let ([ax, ay], [bx, by], [cx, cy]) = (a.at(), b.at(), c.at());
        let area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
        let longest = length(a, b).max(length(b, c)).max(length(c, a));
        area.is_nan() || area <= THIN * self.tolerance * longest
    }

    /// Cuts a triangle as it is, with the points that its neighbours will have on its edges.
    fn finish(&self, corners: [&Site; 3], patch: &mut Patch) -> Result<(), WorkspaceError> {
        let points = [0, 1, 2].map(|i| {
            let mut points = Vec::new();
            self.divisions(corners[i], corners[(i + 1) % 3], &mut points);
            points
        });
        self.cut(Leaf::with_points(self, corners, points), patch)
    }

    fn cut(&self, leaf: Leaf<'_>, patch: &mut Patch) -> Result<(), WorkspaceError> {
        let before = patch.surface_triangles();
        leaf.cut_into(patch)?;
        let added = patch.surface_triangles() - before;
        if self.made.fetch_add(added, Ordering::Relaxed).saturating_add(added) > self.most {
            return Err(WorkspaceError::TooManyTriangles { most: self.most });
        }
        Ok(())
    }

    /// All points at which an edge is halved, in order.
    fn divisions(&self, a: &Site, b: &Site, points: &mut Vec<Site>) {
        let ([ax, ay], [bx, by]) = (a.at(), b.at());
        let middle = Site::new(self.domain, [0.5 * (ax + bx), 0.5 * (ay + by)]);
        if self.edge(a, &middle, b) == Edge::Halved {
            self.divisions(a, &middle, points);
            points.push(middle.clone());
            self.divisions(&middle, b, points);
        }
    }

    /// The first edge is halved.
    fn two(&self, [a, b, c]: [&Site; 3], m: &Site, patch: &mut Patch) -> Result<(), WorkspaceError> {
        self.triangle([a, m, c], patch)?;
        self.triangle([m, b, c], patch)
    }

    /// The first two edges are halved.
    fn three(
        &self,
        [a, b, c]: [&Site; 3],
        [m, n]: [&Site; 2],
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

    /// Decides about an edge. The decision depends on the edge alone, in either direction.
    fn edge(&self, a: &Site, middle: &Site, b: &Site) -> Edge {
        let (a, b) = if b.precedes(a) { (b, a) } else { (a, b) };
        let (mut doubtful, mut changes) = (0_u64, false);
        for curve in (0..LIMITS).chain(FLOOR..CURVES) {
            match shape(a.values[curve], middle.values[curve], b.values[curve]) {
                Shape::Outside if curve < LIMITS => {
                    return if self.hides([a, b], true) { Edge::Halved } else { Edge::Kept };
                }
                Shape::Outside => {}
                Shape::Simple => {
                    changes |= curve < LIMITS && (a.values[curve] < 0.0) != (b.values[curve] < 0.0);
                }
                Shape::Doubtful => doubtful |= 1 << curve,
            }
        }
        let length = length(a, b) / self.tolerance;
        let crossed = |curve: usize| doubtful & (1 << curve) != 0 && self.crossed(curve, [a, middle, b]);
        let halved = length > SHORTEST[0] && ((0..CURVES).any(crossed) || self.hides([a, b], false))
            || length > SHORTEST[1]
                && !self.domain.flat()
                && (self.curved([a, middle, b])
                    || self.hidden([a, b])
                    || changes && self.twisted([a, middle, b]));
        if halved { Edge::Halved } else { Edge::Kept }
    }

    /// Whether a piece of the domain, or a hole, may be hidden near an edge: the edge is so long that its ends and
    /// its middle do not show it.
    fn hides(&self, [a, b]: [&Site; 2], outside: bool) -> bool {
        let length = length(a, b);
        length > SHORTEST[0] * self.tolerance && length > GRAIN * self.cover.grain([a.at(), b.at()], outside)
    }

    /// Whether a limit's curve may cross an edge twice, or close on itself near it, by more than is negligible. Its
    /// depth beyond the edge is the parabola's depth over the limit's gradient.
    fn crossed(&self, curve: usize, [a, middle, b]: [&Site; 3]) -> bool {
        let values = [a, middle, b].map(|site| site.values[curve]);
        let depth = 0.5 * control(values).abs();
        let (length, [ax, ay], [bx, by], [x, y]) = (length(a, b), a.at(), b.at(), middle.at());
        let beside = [x - STEP * (by - ay), y + STEP * (bx - ax)];
        let across = (value(self.domain, curve, &self.domain.column(beside)) - values[1]) / STEP;
        let gradient = across.hypot(values[2] - values[0]) / length;
        depth > SHALLOW * self.tolerance * gradient
    }

    /// Whether slider 1 binds a sheet between an end where slider 2 does and an end where slider 3 does. Its crease
    /// then crosses the edge twice even if the sheets are straight, and the signs at the ends do not show it. Slider
    /// 1 binds by most where the binding changes between the other two.
    fn hidden(&self, [a, b]: [&Site; 2]) -> bool {
        [CREASES, CREASES + 2].into_iter().any(|first| {
            let [start, end] = [a, b].map(|site| site.values[first + 1]);
            let others = a.values[first] < 0.0 && b.values[first] < 0.0;
            others && (start < 0.0 && end > 0.0 || start > 0.0 && end < 0.0) && {
                let ([ax, ay], [bx, by]) = (a.at(), b.at());
                let column = |part: f64| self.domain.column([ax + part * (bx - ax), ay + part * (by - ay)]);
                let change = |part: f64| value(self.domain, first + 1, &column(part));
                let part = root::zero(start, end, CHANGE, change);
                value(self.domain, first, &column(part)) > SHALLOW * self.tolerance
            }
        })
    }

    /// Whether the wall over the edge would need too many chords. Columns that turn along it form a ruled surface,
    /// which two triangles approximate only if the turn is small.
    fn twisted(&self, [a, middle, b]: [&Site; 3]) -> bool {
        let turn = (b.column.s * a.column.c - b.column.c * a.column.s).abs();
        let height = [a, middle, b].iter().fold(0.0, |height: f64, site| {
            let [low, high] = self.domain.ends(&site.column);
            height.max(high - low)
        });
        self.domain.image.turns() && bend::chords(turn, height, self.tolerance) > CHORDS
    }

    /// Whether a sheet deviates from the edge by more than is allowed. Every slider that binds the sheet on the edge
    /// is examined, because the edge will be cut at a crease. Where the table binds the sheet, it is plane.
    fn curved(&self, sites: [&Site; 3]) -> bool {
        let columns = sites.map(|site| &site.column);
        let rates = columns[1].angle_rates(self.domain.machine);
        let slopes = columns[1].drop_rates(self.domain.machine, rates);
        [true, false].into_iter().any(|upper| {
            let sheets = columns.map(|column| self.domain.sheet(column, upper));
            let binding = sheets.map(|heights| Domain::binding_slider(heights, upper));
            (0..3).filter(|slider| binding.contains(slider)).any(|slider| {
                let z = sheets.map(|heights| heights[slider]);
                let image = |i: usize| self.domain.image.point(columns[i], z[i]);
                let (a, m, b) = (image(0), image(1), image(2));
                let off = [0, 1, 2].map(|i| m[i] - 0.5 * (a[i] + b[i]));
                let push = |step: Point, turn: f64| self.domain.image.push(columns[1], z[1], step, turn);
                let [dx, dy] = slopes[slider];
                let normal = cross(push([1.0, 0.0, dx], rates[0]), push([0.0, 1.0, dy], rates[1]));
                dot(off, normal).abs() > FLAT * self.tolerance * dot(normal, normal).sqrt()
            })
        })
    }
}

fn length(a: &Site, b: &Site) -> f64 {
    (a.column.x - b.column.x).hypot(a.column.y - b.column.y)
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
