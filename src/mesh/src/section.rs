//! The cut of a mesh by a plane z = constant.

use std::collections::BTreeMap;

use crate::edges::Edges;
use crate::{Mesh, sum};

/// A closed polygon in the plane of the cut. The last point joins the first.
#[derive(Clone, Debug, PartialEq)]
pub struct Contour {
    /// The corners (x, y), mm. The mesh's inside lies to the left, so that an outer contour runs
    /// counter-clockwise in x and y and a hole's clockwise.
    pub points: Vec<[f64; 2]>,
}

impl Contour {
    /// Computes the area inside; it is negative for a hole.
    ///
    /// # Units
    ///
    /// mm².
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_mesh::Contour;
    ///
    /// let square = Contour { points: vec![[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]] };
    /// assert_eq!(square.area(), 4.0);
    /// ```
    pub fn area(&self) -> f64 {
        let Some(&[x, y]) = self.points.first() else { return 0.0 };
        let following = self.points.iter().cycle().skip(1);
        let doubled =
            self.points.iter().zip(following).map(|(a, b)| (a[0] - x) * (b[1] - y) - (b[0] - x) * (a[1] - y));
        sum::compensated(doubled) / 2.0
    }
}

impl Mesh {
    /// Cuts a watertight mesh at the height `z`. If the mesh is not watertight, a straight line closes each open
    /// contour.
    ///
    /// A vertex exactly at the height counts as above it, as if the plane lay infinitesimally lower in z. So every cut
    /// crosses whole edges, and a flat face in the plane appears if the inside lies on its lower side.
    ///
    /// # Units
    ///
    /// Millimetres.
    ///
    /// # Examples
    ///
    /// ```
    #[doc = include_str!("doctest/tetrahedron.md")]
    /// let contours = mesh.section(3.0);
    /// assert_eq!(contours.len(), 1);
    /// assert!((contours[0].area() - 4.5).abs() < 1e-12, "half a square of 3 mm");
    /// # Ok::<(), MeshError>(())
    /// ```
    pub fn section(&self, z: f64) -> Vec<Contour> {
        let mut following = self.following(z);
        let mut contours = Vec::new();
        while let Some((&start, _)) = following.first_key_value() {
            let mut points = Vec::new();
            let mut corner = start;
            while let Some(next) = following.remove(&corner) {
                let point = self.crossing(corner, z);
                if points.last() != Some(&point) {
                    points.push(point);
                }
                corner = next;
            }
            if points.first() == points.last() {
                points.pop();
            }
            // A region that only touches the plane leaves a point or a line.
            if points.len() > 2 {
                contours.push(Contour { points });
            }
        }
        contours
    }

    /// Maps each side that passes down through the plane to the next such side along its contour. Both are named by
    /// the corner at which they start.
    ///
    /// A cut triangle has one side down and one side up, and the contour crosses it from the first to the second.
    /// There it enters the neighbour, for which the same edge is the side down.
    fn following(&self, z: f64) -> BTreeMap<u32, u32> {
        let mut following = BTreeMap::new();
        for sides in Edges::among(self, |from, to| self.above(from, z) != self.above(to, z)).iter() {
            let (down, up): (Vec<u32>, Vec<u32>) =
                sides.iter().map(|side| side.corner).partition(|&corner| self.goes_down(corner, z));
            for (up, down) in up.into_iter().zip(down) {
                let first = up - up % 3;
                let entrance = (first..first + 3).find(|&corner| self.goes_down(corner, z));
                following.extend(entrance.map(|entrance| (entrance, down)));
            }
        }
        following
    }

    fn above(&self, vertex: u32, z: f64) -> bool {
        self.positions()[vertex as usize][2] >= z
    }

    fn goes_down(&self, corner: u32, z: f64) -> bool {
        let [from, to] = self.side(corner);
        self.above(from, z) && !self.above(to, z)
    }

    /// The point where a side that goes down meets the plane; exactly its start if that is in the plane.
    fn crossing(&self, corner: u32, z: f64) -> [f64; 2] {
        let [from, to] = self.side(corner).map(|vertex| self.positions()[vertex as usize]);
        let fraction = (from[2] - z) / (from[2] - to[2]);
        [from[0] + fraction * (to[0] - from[0]), from[1] + fraction * (to[1] - from[1])]
    }
}
