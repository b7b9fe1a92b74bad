//! Points inside a closed surface of triangles, and the nearest points of its triangles.

use std::collections::HashMap;

use super::boundary_search::moved;
use crate::pose::Point;
use crate::workspace::vector::{distance, dot, minus};

/// A closed surface whose triangles are found by x and y.
pub(super) struct ClosedSurface<'a> {
    positions: &'a [Point],
    pub(super) triangles: &'a [[u32; 3]],
    /// Width of a square of x and y.
    width: f64,
    /// The triangles above and below each square.
    squares: HashMap<[i64; 2], Vec<u32>>,
}

impl<'a> ClosedSurface<'a> {
    pub(super) fn new(positions: &'a [Point], triangles: &'a [[u32; 3]], width: f64) -> Self {
        let mut squares: HashMap<[i64; 2], Vec<u32>> = HashMap::new();
        for (number, corners) in (0_u32..).zip(triangles) {
            let corners = corners.map(|corner| square(positions[corner as usize], width));
            let range = |axis: usize| {
                let all = corners.map(|corner| corner[axis]);
                all.iter().copied().fold(i64::MAX, i64::min)..=all.iter().copied().fold(i64::MIN, i64::max)
            };
            for x in range(0) {
                for y in range(1) {
                    squares.entry([x, y]).or_default().push(number);
                }
            }
        }
        Self { positions, triangles, width, squares }
    }

    pub(super) fn corners(&self, triangle: usize) -> [Point; 3] {
        self.triangles[triangle].map(|corner| self.positions[corner as usize])
    }

    /// Whether a point is inside: the line upwards crosses an odd number of triangles.
    pub(super) fn contains(&self, at: Point) -> bool {
        let near = self.squares.get(&square(at, self.width)).map_or(&[][..], |near| near);
        let crossed = near.iter().filter(|number| {
            let [a, b, c] = self.corners(**number as usize);
            let side = |p: Point, q: Point| (q[0] - p[0]) * (at[1] - p[1]) - (q[1] - p[1]) * (at[0] - p[0]);
            let [u, v, w] = [side(b, c), side(c, a), side(a, b)];
            let is_over = (u > 0.0) == (v > 0.0) && (v > 0.0) == (w > 0.0);
            is_over && (u * a[2] + v * b[2] + w * c[2]) / (u + v + w) > at[2]
        });
        crossed.count() % 2 == 1
    }

    /// The point of the surface that is nearest to another one.
    pub(super) fn nearest(&self, at: Point) -> Option<Point> {
        let all = (0..self.triangles.len()).map(|triangle| nearest(self.corners(triangle), at));
        all.min_by(|a, b| distance(*a, at).total_cmp(&distance(*b, at)))
    }
}

#[expect(clippy::cast_possible_truncation, reason = "saturates far beyond the machine")]
fn square(at: Point, width: f64) -> [i64; 2] {
    [0, 1].map(|axis| (at[axis] / width).floor() as i64)
}

/// The point of a triangle that is nearest to another one.
fn nearest([a, b, c]: [Point; 3], at: Point) -> Point {
    let (ab, ac, to) = (minus(b, a), minus(c, a), minus(at, a));
    let [aa, bb, cc] = [dot(ab, ab), dot(ab, ac), dot(ac, ac)];
    let (u, v) = (dot(ab, to) * cc - dot(ac, to) * bb, dot(ac, to) * aa - dot(ab, to) * bb);
    let whole = aa * cc - bb * bb;
    if u >= 0.0 && v >= 0.0 && whole > 0.0 && u + v <= whole {
        return moved(moved(a, ab, u / whole), ac, v / whole);
    }
    let on = |from: Point, to: Point| {
        let along = minus(to, from);
        let square = dot(along, along);
        let part = if square > 0.0 { (dot(minus(at, from), along) / square).clamp(0.0, 1.0) } else { 0.0 };
        moved(from, along, part)
    };
    let [ab, bc, ca] = [on(a, b), on(b, c), on(c, a)];
    let nearer = |p: Point, q: Point| if distance(q, at) < distance(p, at) { q } else { p };
    nearer(nearer(ab, bc), ca)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use super::ClosedSurface;
    use crate::toolpath::placement::even_numbers;
    use crate::workspace::vector::distance;

    #[test]
    fn points_inside_an_octahedron_and_their_distance() {
        let positions = [
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 0.0, 1.0],
            [-1.0, 0.0, 0.0],
            [0.0, -1.0, 0.0],
            [0.0, 0.0, -1.0],
        ];
        let triangles =
            [[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]];
        let surface = ClosedSurface::new(&positions, &triangles, 0.3);
        for i in 0..500 {
            let at = even_numbers::<3>(i).map(|c| 3.0 * c - 1.5);
            let sum: f64 = at.iter().map(|c| c.abs()).sum();
            assert_eq!(surface.contains(at), sum < 1.0, "{at:?}");
            let found = surface.nearest(at).unwrap();
            let on: f64 = found.iter().map(|c| c.abs()).sum();
            assert!((on - 1.0).abs() < 1e-12);
            // The distance from the nearest face's plane, if that is above the face.
            let plane = (sum - 1.0).abs() / 3.0_f64.sqrt();
            assert!(distance(found, at) >= plane - 1e-12);
            assert!(sum > 1.0 || distance(found, at) < plane + 1e-12);
        }
    }
}
