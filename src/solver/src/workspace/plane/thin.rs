//! Detection of a workspace that is nowhere as thick as the tolerance.

use super::super::cover::Cover;
use super::{Plane, Vertex};

impl Plane {
    /// Whether no column is as high as the tolerance, or the domain is thin: its area over the length of its boundary
    /// is less than that of a disc as wide as the tolerance, and no inside box is half as wide.
    pub(in super::super) fn is_thin(&self, cover: &Cover, tolerance: f64) -> bool {
        let square = |vertex: &Vertex| -> f64 {
            let [low, high] = vertex.ends;
            (0..3).map(|i| (high[i] - low[i]).powi(2)).sum()
        };
        self.vertices.iter().all(|vertex| square(vertex) < tolerance * tolerance)
            || self.area() < 0.25 * tolerance * self.circumference() && !cover.holds(0.5 * tolerance)
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
        self.rims.iter().map(|rim| length(rim.ends)).sum()
    }
}
