//! The triangles of the plane domain and the sides of its boundary.

use crate::pose::Point;
use crate::workspace::cover::Cover;
use crate::workspace::domain::{ColumnEnd, Limit};

/// A vertex of the plane and its column's ends in the image.
#[derive(Clone, Copy, Debug)]
pub(in crate::workspace) struct PlaneVertex {
    pub(in crate::workspace) at: [f64; 2],
    /// Lower and upper.
    pub(in crate::workspace) ends: [Point; 2],
    /// Whether the two ends are the same point.
    pub(in crate::workspace) pinched: bool,
}

/// A triangle of the plane, counter-clockwise, and what bounds the columns over it below and above.
#[derive(Clone, Copy, Debug)]
pub(in crate::workspace) struct PlaneTriangle {
    pub(in crate::workspace) corners: [u32; 3],
    pub(in crate::workspace) column_ends: [ColumnEnd; 2],
}

/// A side of the domain, which lies to its left, and the limit that ends the domain there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::workspace) struct BoundarySide {
    pub(in crate::workspace) ends: [u32; 2],
    pub(in crate::workspace) limit: Limit,
}

/// The triangles of the domain, and the sides of its boundary with the domain to their left.
#[derive(Default)]
pub(in crate::workspace) struct PlaneMesh {
    pub(in crate::workspace) vertices: Vec<PlaneVertex>,
    pub(in crate::workspace) triangles: Vec<PlaneTriangle>,
    pub(in crate::workspace) boundary: Vec<BoundarySide>,
}

impl PlaneMesh {
    /// Triangles of a surface over it: two sheets, and two for each side's wall.
    pub(in crate::workspace) fn surface_triangles(&self) -> usize {
        2 * (self.triangles.len() + self.boundary.len())
    }

    /// Whether the sides are closed rings.
    pub(in crate::workspace) fn closes(&self) -> bool {
        let mut balance = vec![0_i32; self.vertices.len()];
        for [from, to] in self.boundary.iter().map(|side| side.ends) {
            balance[from as usize] += 1;
            balance[to as usize] -= 1;
        }
        balance.into_iter().all(|difference| difference == 0)
    }

    /// Whether the workspace is nowhere as thick as the tolerance: no column is as high, or the domain is thin. Then
    /// its area over the length of its boundary is less than that of a disc as wide as the tolerance, and no inside
    /// box is half as wide.
    pub(in crate::workspace) fn is_thin(&self, cover: &Cover, tolerance: f64) -> bool {
        let square = |vertex: &PlaneVertex| -> f64 {
            let [low, high] = vertex.ends;
            (0..3).map(|i| (high[i] - low[i]).powi(2)).sum()
        };
        self.vertices.iter().all(|vertex| square(vertex) < tolerance * tolerance)
            || self.area() < 0.25 * tolerance * self.circumference() && !cover.has_inside_box(0.5 * tolerance)
    }

    fn area(&self) -> f64 {
        let double = |corners: [u32; 3]| {
            let [[ax, ay], [bx, by], [cx, cy]] = corners.map(|corner| self.vertices[corner as usize].at);
            (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        };
        0.5 * self.triangles.iter().map(|triangle| double(triangle.corners)).sum::<f64>()
    }

    fn circumference(&self) -> f64 {
        let length = |ends: [u32; 2]| {
            let [[ax, ay], [bx, by]] = ends.map(|end| self.vertices[end as usize].at);
            (bx - ax).hypot(by - ay)
        };
        self.boundary.iter().map(|side| length(side.ends)).sum()
    }
}
