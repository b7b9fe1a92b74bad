//! The mesh type.

use crate::{MeshError, Swatch};

/// Triangles over shared vertices, each triangle with a tag; lengths in millimetres.
///
/// A triangle's corners run counter-clockwise seen from outside. Two triangles share an edge when they name
/// the same two vertices; equal coordinates under different indices are different vertices.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    tags: Vec<u8>,
    palette: Vec<Swatch>,
}

impl Mesh {
    /// Makes a mesh of vertices, triangles, a tag for each triangle, and the palette that the tags index.
    ///
    /// It refuses only input that makes other functions meaningless. [`Mesh::audit`] examines the topology.
    ///
    /// # Units
    ///
    /// `positions` are millimetres.
    ///
    /// # Errors
    ///
    /// - [`MeshError::TooLarge`]: 32-bit numbers cannot count the vertices or the corners.
    /// - [`MeshError::TagCount`]: there are not as many tags as triangles.
    /// - [`MeshError::NoSuchTag`]: a tag has no swatch in the palette.
    /// - [`MeshError::NotFinite`]: a coordinate is infinite or NaN.
    /// - [`MeshError::NoSuchVertex`]: a triangle names a vertex that does not exist.
    /// - [`MeshError::Unused`]: no triangle uses some vertex.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_mesh::{Mesh, MeshError, Swatch};
    ///
    /// let corners = vec![[0.0, 0.0, 0.0], [6.0, 0.0, 0.0], [0.0, 6.0, 0.0], [0.0, 0.0, 6.0]];
    /// let triangles = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
    /// let palette = vec![Swatch { name: "stroke".to_owned(), rgb: [80, 80, 80] }];
    /// let mesh = Mesh::new(corners.clone(), triangles.clone(), vec![0; 4], palette.clone())?;
    /// assert!(mesh.audit().is_watertight());
    ///
    /// let refused = Mesh::new(corners, triangles, vec![0; 3], palette);
    /// assert_eq!(refused, Err(MeshError::TagCount { triangles: 4, tags: 3 }));
    /// # Ok::<(), MeshError>(())
    /// ```
    pub fn new(
        positions: Vec<[f64; 3]>,
        triangles: Vec<[u32; 3]>,
        tags: Vec<u8>,
        palette: Vec<Swatch>,
    ) -> Result<Self, MeshError> {
        // Corners are numbered with 32 bits.
        if u32::try_from(positions.len()).is_err()
            || u32::try_from(triangles.len().saturating_mul(3)).is_err()
        {
            return Err(MeshError::TooLarge);
        }
        if tags.len() != triangles.len() {
            return Err(MeshError::TagCount { triangles: triangles.len(), tags: tags.len() });
        }
        if let Some(triangle) = tags.iter().position(|&tag| usize::from(tag) >= palette.len()) {
            return Err(MeshError::NoSuchTag { triangle, tag: tags[triangle] });
        }
        if let Some(vertex) = positions.iter().position(|p| p.iter().any(|c| !c.is_finite())) {
            return Err(MeshError::NotFinite { vertex });
        }
        all_used(positions.len(), &triangles)?;
        Ok(Self { positions, triangles, tags, palette })
    }

    /// The vertices.
    ///
    /// # Units
    ///
    /// Millimetres.
    ///
    /// # Examples
    ///
    /// ```
    #[doc = include_str!("doctest/tetrahedron.md")]
    /// assert_eq!(mesh.positions()[1], [6.0, 0.0, 0.0]);
    /// # Ok::<(), MeshError>(())
    /// ```
    pub fn positions(&self) -> &[[f64; 3]] {
        &self.positions
    }

    /// The triangles: for each the numbers of its three vertices, counter-clockwise seen from outside.
    ///
    /// # Examples
    ///
    /// ```
    #[doc = include_str!("doctest/tetrahedron.md")]
    /// assert_eq!(mesh.triangles()[2], [1, 2, 3]);
    /// # Ok::<(), MeshError>(())
    /// ```
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Each triangle's tag: an index into the palette.
    ///
    /// # Examples
    ///
    /// ```
    #[doc = include_str!("doctest/tetrahedron.md")]
    /// assert_eq!(mesh.tags(), [0, 0, 1, 0]);
    /// # Ok::<(), MeshError>(())
    /// ```
    pub fn tags(&self) -> &[u8] {
        &self.tags
    }

    /// The name and the colour of each tag.
    ///
    /// # Examples
    ///
    /// ```
    #[doc = include_str!("doctest/tetrahedron.md")]
    /// assert_eq!(mesh.palette()[1].name, "slope");
    /// # Ok::<(), MeshError>(())
    /// ```
    pub fn palette(&self) -> &[Swatch] {
        &self.palette
    }

    /// Computes a tag for each vertex: of the tags of its triangles the first in the palette.
    ///
    /// # Examples
    ///
    /// ```
    #[doc = include_str!("doctest/tetrahedron.md")]
    /// assert_eq!(mesh.vertex_tags(), [0, 0, 0, 0], "every vertex belongs to a wall");
    /// # Ok::<(), MeshError>(())
    /// ```
    pub fn vertex_tags(&self) -> Vec<u8> {
        let mut lowest = vec![u8::MAX; self.positions.len()];
        for (triangle, &tag) in self.triangles.iter().zip(&self.tags) {
            for &vertex in triangle {
                lowest[vertex as usize] = lowest[vertex as usize].min(tag);
            }
        }
        lowest
    }

    /// The three corners of a triangle of this mesh.
    pub(crate) fn corners(&self, triangle: &[u32; 3]) -> [[f64; 3]; 3] {
        triangle.map(|vertex| self.positions[vertex as usize])
    }
}

fn all_used(vertices: usize, triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    let mut used = vec![false; vertices];
    for (triangle, corners) in triangles.iter().enumerate() {
        for &vertex in corners {
            match used.get_mut(vertex as usize) {
                Some(seen) => *seen = true,
                None => return Err(MeshError::NoSuchVertex { triangle, vertex }),
            }
        }
    }
    used.iter().position(|seen| !seen).map_or(Ok(()), |vertex| Err(MeshError::Unused { vertex }))
}

#[cfg(test)]
mod tests {
    use super::Mesh;
    use crate::{MeshError, Swatch};

    const CORNERS: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

    fn palette() -> Vec<Swatch> {
        vec![Swatch { name: "only".to_owned(), rgb: [1, 2, 3] }]
    }

    #[test]
    fn invalid_input_is_refused_with_its_error() {
        let new = |positions: &[[f64; 3]], triangle, tags: &[u8]| {
            Mesh::new(positions.to_vec(), vec![triangle], tags.to_vec(), palette()).map(|_| ())
        };
        assert_eq!(new(&CORNERS, [0, 1, 2], &[0]), Ok(()));
        assert_eq!(new(&CORNERS, [0, 1, 2], &[]), Err(MeshError::TagCount { triangles: 1, tags: 0 }));
        assert_eq!(new(&CORNERS, [0, 1, 2], &[1]), Err(MeshError::NoSuchTag { triangle: 0, tag: 1 }));
        assert_eq!(new(&CORNERS, [0, 1, 3], &[0]), Err(MeshError::NoSuchVertex { triangle: 0, vertex: 3 }));
        assert_eq!(new(&CORNERS, [0, 1, 1], &[0]), Err(MeshError::Unused { vertex: 2 }));
        let hole = [CORNERS[0], [f64::NAN, 0.0, 0.0], CORNERS[2]];
        assert_eq!(new(&hole, [0, 1, 2], &[0]), Err(MeshError::NotFinite { vertex: 1 }));
    }

    #[test]
    fn a_mesh_may_be_empty() {
        assert!(Mesh::new(vec![], vec![], vec![], vec![]).is_ok());
    }
}
