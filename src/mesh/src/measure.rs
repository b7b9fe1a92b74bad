//! Bounds, volume and area of a mesh.

use crate::vector::{add, cross, dot, scale, sub};
use crate::{Mesh, facet, sum};

/// The smallest box along the axes that contains a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The least of each coordinate, mm.
    pub min: [f64; 3],
    /// The greatest of each coordinate, mm.
    pub max: [f64; 3],
}

impl Bounds {
    /// The centre of the box.
    ///
    /// # Units
    ///
    /// Millimetres.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_mesh::Bounds;
    ///
    /// let bounds = Bounds { min: [0.0, 2.0, -4.0], max: [6.0, 4.0, 4.0] };
    /// assert_eq!(bounds.centre(), [3.0, 3.0, 0.0]);
    /// ```
    pub fn centre(&self) -> [f64; 3] {
        scale(add(self.min, self.max), 0.5)
    }
}

impl Mesh {
    /// The smallest box along the axes that contains the mesh; `None` if the mesh is empty.
    ///
    /// # Units
    ///
    /// Millimetres.
    ///
    /// # Examples
    ///
    /// ```
    #[doc = include_str!("doctest/tetrahedron.md")]
    /// assert_eq!(mesh.bounds().map(|bounds| bounds.max), Some([6.0; 3]));
    /// # Ok::<(), MeshError>(())
    /// ```
    pub fn bounds(&self) -> Option<Bounds> {
        let (first, rest) = self.positions().split_first()?;
        Some(rest.iter().fold(Bounds { min: *first, max: *first }, |bounds, p| Bounds {
            min: [bounds.min[0].min(p[0]), bounds.min[1].min(p[1]), bounds.min[2].min(p[2])],
            max: [bounds.max[0].max(p[0]), bounds.max[1].max(p[1]), bounds.max[2].max(p[2])],
        }))
    }

    /// Computes the volume that the triangles enclose. It is negative if the triangles face inwards, and has no meaning
    /// if the mesh is not watertight.
    ///
    /// # Units
    ///
    /// mm³.
    ///
    /// # References
    ///
    /// The divergence theorem: the sum of the signed tetrahedra over the triangles.
    ///
    /// # Examples
    ///
    /// ```
    #[doc = include_str!("doctest/tetrahedron.md")]
    /// assert!((mesh.volume() - 36.0).abs() < 1e-12);
    /// # Ok::<(), MeshError>(())
    /// ```
    pub fn volume(&self) -> f64 {
        // The tetrahedra have their apex at the centre of the mesh, not at the frame's origin: a mesh far from the
        // origin would lose digits.
        let apex = self.bounds().map_or([0.0; 3], |bounds| bounds.centre());
        let six_fold = self.triangles().iter().map(|triangle| {
            let [a, b, c] = self.corners(triangle).map(|corner| sub(corner, apex));
            dot(a, cross(b, c))
        });
        sum::compensated(six_fold) / 6.0
    }

    /// Computes the area of all triangles.
    ///
    /// # Units
    ///
    /// mm².
    ///
    /// # Examples
    ///
    /// ```
    #[doc = include_str!("doctest/tetrahedron.md")]
    /// let (wall, slope) = (18.0, 18.0 * 3_f64.sqrt());
    /// assert!((mesh.area() - 3.0 * wall - slope).abs() < 1e-12);
    /// # Ok::<(), MeshError>(())
    /// ```
    pub fn area(&self) -> f64 {
        sum::compensated(self.triangles().iter().map(|triangle| facet::area(self.corners(triangle))))
    }
}
