//! Whether a workspace is nowhere as thick as the tolerance.

use super::{Plane, Vertex};

impl Plane {
    /// Whether no column is as high as the tolerance, or no triangle's middle half of it away from
    /// the domain's boundary.
    pub(in super::super) fn is_thin(&self, tolerance: f64) -> bool {
        let square = |vertex: &Vertex| -> f64 {
            let [low, high] = vertex.ends;
            (0..3).map(|i| (high[i] - low[i]).powi(2)).sum()
        };
        if self.vertices.iter().all(|vertex| square(vertex) < tolerance * tolerance) {
            return true;
        }
        // A disc as wide as the tolerance has this area over its circumference.
        let (area, around) = (self.area(), self.circumference());
        area < 0.25 * tolerance * around
            && !self.triangles.iter().any(|triangle| {
                let corners = triangle.corners.map(|corner| self.vertices[corner as usize].at);
                let middle = [0, 1].map(|axis| corners.iter().map(|at| at[axis]).sum::<f64>() / 3.0);
                self.rims.iter().all(|rim| {
                    let [from, to] = rim.ends.map(|end| self.vertices[end as usize].at);
                    distance(middle, from, to) >= 0.5 * tolerance
                })
            })
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

/// Distance of a point from a segment.
fn distance([x, y]: [f64; 2], [ax, ay]: [f64; 2], [bx, by]: [f64; 2]) -> f64 {
    let (dx, dy) = (bx - ax, by - ay);
    let square = dx * dx + dy * dy;
    let part = if square > 0.0 { (((x - ax) * dx + (y - ay) * dy) / square).clamp(0.0, 1.0) } else { 0.0 };
    (x - ax - part * dx).hypot(y - ay - part * dy)
}
