//! How much there is of a mesh, and where.

use crate::vector::{add, cross, dot, scale, sub};
use crate::{Mesh, facet, sum};

/// The smallest box along the axes that holds a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The least of each coordinate, mm.
    pub min: [f64; 3],
    /// The greatest of each coordinate, mm.
    pub max: [f64; 3],
}

impl Bounds {
    /// The box's centre, mm.
    pub fn centre(&self) -> [f64; 3] {
        scale(add(self.min, self.max), 0.5)
    }
}

impl Mesh {
    /// The box that holds the mesh; none if it is empty.
    pub fn bounds(&self) -> Option<Bounds> {
        let (first, rest) = self.positions().split_first()?;
        Some(rest.iter().fold(Bounds { min: *first, max: *first }, |held, p| Bounds {
            min: [held.min[0].min(p[0]), held.min[1].min(p[1]), held.min[2].min(p[2])],
            max: [held.max[0].max(p[0]), held.max[1].max(p[1]), held.max[2].max(p[2])],
        }))
    }

    /// The volume that the triangles enclose, mm³: negative where they face inwards, and without meaning
    /// where the mesh is not watertight.
    pub fn volume(&self) -> f64 {
        // Tetrahedra from the centre, not from the frame's origin: a mesh far from it would lose digits.
        let apex = self.bounds().map_or([0.0; 3], |bounds| bounds.centre());
        let six_fold = self.triangles().iter().map(|triangle| {
            let [a, b, c] = self.corners(triangle).map(|corner| sub(corner, apex));
            dot(a, cross(b, c))
        });
        sum::compensated(six_fold) / 6.0
    }

    /// The area of all triangles, mm².
    pub fn area(&self) -> f64 {
        sum::compensated(self.triangles().iter().map(|triangle| facet::area(self.corners(triangle))))
    }
}
