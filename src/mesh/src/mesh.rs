//! The mesh itself.

use crate::{MeshFault, Swatch};

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
    /// A mesh of vertices, triangles, a tag for each triangle, and what the tags mean.
    ///
    /// Only what would make the other functions meaningless is refused here; [`Mesh::audit`] tells the rest.
    pub fn new(
        positions: Vec<[f64; 3]>,
        triangles: Vec<[u32; 3]>,
        tags: Vec<u8>,
        palette: Vec<Swatch>,
    ) -> Result<Self, MeshFault> {
        // Corners are numbered, and the largest number is kept free to mean none.
        if u32::try_from(positions.len()).is_err()
            || u32::try_from(triangles.len().saturating_mul(3)).is_err()
        {
            return Err(MeshFault::TooLarge);
        }
        if tags.len() != triangles.len() {
            return Err(MeshFault::TagCount { triangles: triangles.len(), tags: tags.len() });
        }
        if let Some(triangle) = tags.iter().position(|&tag| usize::from(tag) >= palette.len()) {
            return Err(MeshFault::NoSuchTag { triangle, tag: tags[triangle] });
        }
        if let Some(vertex) = positions.iter().position(|p| p.iter().any(|c| !c.is_finite())) {
            return Err(MeshFault::NotFinite { vertex });
        }
        all_used(positions.len(), &triangles)?;
        Ok(Self { positions, triangles, tags, palette })
    }

    /// The vertices.
    pub fn positions(&self) -> &[[f64; 3]] {
        &self.positions
    }

    /// The triangles, each as three vertices.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Each triangle's tag.
    pub fn tags(&self) -> &[u8] {
        &self.tags
    }

    /// What the tags mean.
    pub fn palette(&self) -> &[Swatch] {
        &self.palette
    }

    /// A tag for each vertex: where several meet, the one that comes first in the palette.
    pub fn vertex_tags(&self) -> Vec<u8> {
        let mut lowest = vec![u8::MAX; self.positions.len()];
        for (triangle, &tag) in self.triangles.iter().zip(&self.tags) {
            for &vertex in triangle {
                let held = &mut lowest[vertex as usize];
                *held = tag.min(*held);
            }
        }
        lowest
    }

    /// The three corners of a triangle of this mesh.
    pub(crate) fn corners(&self, triangle: &[u32; 3]) -> [[f64; 3]; 3] {
        triangle.map(|vertex| self.positions[vertex as usize])
    }
}

fn all_used(vertices: usize, triangles: &[[u32; 3]]) -> Result<(), MeshFault> {
    let mut used = vec![false; vertices];
    for (triangle, corners) in triangles.iter().enumerate() {
        for &vertex in corners {
            match used.get_mut(vertex as usize) {
                Some(seen) => *seen = true,
                None => return Err(MeshFault::NoSuchVertex { triangle, vertex }),
            }
        }
    }
    used.iter().position(|seen| !seen).map_or(Ok(()), |vertex| Err(MeshFault::Unused { vertex }))
}

#[cfg(test)]
mod tests {
    use super::Mesh;
    use crate::{MeshFault, Swatch};

    const CORNERS: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

    fn palette() -> Vec<Swatch> {
        vec![Swatch { name: "only".to_owned(), rgb: [1, 2, 3] }]
    }

    #[test]
    fn faults_are_named() {
        let new = |positions: &[[f64; 3]], triangle, tags: &[u8]| {
            Mesh::new(positions.to_vec(), vec![triangle], tags.to_vec(), palette()).map(|_| ())
        };
        assert_eq!(new(&CORNERS, [0, 1, 2], &[0]), Ok(()));
        assert_eq!(new(&CORNERS, [0, 1, 2], &[]), Err(MeshFault::TagCount { triangles: 1, tags: 0 }));
        assert_eq!(new(&CORNERS, [0, 1, 2], &[1]), Err(MeshFault::NoSuchTag { triangle: 0, tag: 1 }));
        assert_eq!(new(&CORNERS, [0, 1, 3], &[0]), Err(MeshFault::NoSuchVertex { triangle: 0, vertex: 3 }));
        assert_eq!(new(&CORNERS, [0, 1, 1], &[0]), Err(MeshFault::Unused { vertex: 2 }));
        let hole = [CORNERS[0], [f64::NAN, 0.0, 0.0], CORNERS[2]];
        assert_eq!(new(&hole, [0, 1, 2], &[0]), Err(MeshFault::NotFinite { vertex: 1 }));
    }

    #[test]
    fn nothing_is_a_mesh() {
        assert!(Mesh::new(vec![], vec![], vec![], vec![]).is_ok());
    }
}
