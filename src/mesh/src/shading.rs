//! Normals for display: smooth on the surface, discontinuous at its creases.

use crate::edges::{Edges, Side};
use crate::groups::Groups;
use crate::union_find::UnionFind;
use crate::vector::{add, dot, norm, scale};
use crate::{Mesh, facet};

/// A vertex of the mesh with the normal of one smooth patch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ShadedVertex {
    /// The mesh's vertex.
    pub(crate) vertex: u32,
    /// The patch's unit normal there.
    pub(crate) normal: [f64; 3],
    /// The patch's tag.
    pub(crate) tag: u8,
}

/// A mesh whose vertices are split along the creases.
pub(crate) struct Shading {
    /// The split vertices, in the order in which the triangles of the groups name them first, so by tag.
    pub(crate) vertices: Vec<ShadedVertex>,
    /// For each corner of each triangle, in the order of the groups, its split vertex.
    pub(crate) corners: Vec<u32>,
}

impl Shading {
    /// Splits the vertices along edges that bend by more than `crease` (radians) or that separate two tags.
    ///
    /// A patch's normal at a vertex is the mean of its triangles' normals, weighted by their angles there. It does
    /// not depend on how a flat polygon is triangulated.
    pub(crate) fn of(mesh: &Mesh, crease: f64, groups: &Groups) -> Self {
        let normals: Vec<_> =
            mesh.triangles().iter().map(|triangle| facet::normal(mesh.corners(triangle))).collect();
        let mut shading = split(mesh, &mut fans(mesh, &normals, crease), groups);
        for (position, &triangle) in groups.order().iter().enumerate() {
            let Some(normal) = normals[triangle as usize] else { continue };
            let corners = mesh.corners(&mesh.triangles()[triangle as usize]);
            for at in 0..3 {
                let patch = &mut shading.vertices[shading.corners[3 * position + at] as usize].normal;
                *patch = add(*patch, scale(normal, facet::angle(corners, at)));
            }
        }
        for vertex in &mut shading.vertices {
            vertex.normal = unit(vertex.normal);
        }
        shading
    }
}

/// The corners that share a normal: joined across every smooth edge, at both of its ends.
fn fans(mesh: &Mesh, normals: &[Option<[f64; 3]>], crease: f64) -> UnionFind {
    let flattest = crease.cos();
    let smooth = |a: Side, b: Side| {
        let is_flat = match (normals[a.triangle()], normals[b.triangle()]) {
            (Some(n), Some(m)) => dot(n, m) >= flattest,
            // A triangle without a normal cannot make a crease; it takes its neighbours' normal.
            _ => true,
        };
        is_flat && a.rising != b.rising && mesh.tags()[a.triangle()] == mesh.tags()[b.triangle()]
    };
    let mut fans = UnionFind::new(mesh.corner_count());
    for sides in Edges::of(mesh).iter() {
        if let [a, b] = *sides
            && smooth(a, b)
        {
            fans.union(a.ends()[0], b.ends()[0]);
            fans.union(a.ends()[1], b.ends()[1]);
        }
    }
    fans
}

/// One vertex for each fan, its normal still zero.
fn split(mesh: &Mesh, fans: &mut UnionFind, groups: &Groups) -> Shading {
    let mut split_vertex: Vec<Option<u32>> = vec![None; mesh.triangles().len() * 3];
    let mut shading = Shading { vertices: Vec::new(), corners: Vec::with_capacity(split_vertex.len()) };
    let mut next = 0;
    for &triangle in groups.order() {
        for (corner, &vertex) in (3 * triangle..).zip(&mesh.triangles()[triangle as usize]) {
            let number = split_vertex[fans.find(corner) as usize].get_or_insert_with(|| {
                let tag = mesh.tags()[triangle as usize];
                shading.vertices.push(ShadedVertex { vertex, normal: [0.0; 3], tag });
                next += 1;
                next - 1
            });
            shading.corners.push(*number);
        }
    }
    shading
}

/// The direction of a vector. A zero vector (all triangles flat, or facing each other) gets an arbitrary direction.
fn unit(sum: [f64; 3]) -> [f64; 3] {
    let length = norm(sum);
    if length > 1e-9 { scale(sum, length.recip()) } else { [0.0, 0.0, 1.0] }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use super::Shading;
    use crate::groups::Groups;
    use crate::{Mesh, Swatch};

    /// Two squares at a right angle along the y axis, hinged with shared vertices.
    fn hinge(tags: [u8; 4]) -> Mesh {
        let positions = vec![
            [0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [1.0, 0.0, 0.0],
            [1.0, 1.0, 0.0],
            [0.0, 0.0, -1.0],
            [0.0, 1.0, -1.0],
        ];
        let triangles = vec![[0, 2, 3], [0, 3, 1], [0, 1, 5], [0, 5, 4]];
        let palette = ["a", "b"].map(|name| Swatch { name: name.to_owned(), rgb: [0; 3] }).to_vec();
        Mesh::new(positions, triangles, tags.to_vec(), palette).unwrap()
    }

    fn shaded(tags: [u8; 4], crease: f64) -> Shading {
        let mesh = hinge(tags);
        Shading::of(&mesh, crease.to_radians(), &Groups::of(&mesh))
    }

    fn assert_near(found: [f64; 3], wanted: [f64; 3]) {
        assert!(found.iter().zip(&wanted).all(|(f, w)| (f - w).abs() < 1e-12), "{found:?} is not {wanted:?}");
    }

    #[test]
    fn only_a_sharp_edge_splits_its_vertices() {
        let creased = shaded([0; 4], 30.0);
        assert_eq!(creased.vertices.len(), 8);
        assert_near(creased.vertices[0].normal, [0.0, 0.0, 1.0]);

        let bent = shaded([0; 4], 100.0);
        assert_eq!(bent.vertices.len(), 6);
        // Each square has a right angle at vertex 0, however it is cut: the mean is the bisector.
        let half = 0.5_f64.sqrt();
        assert_near(bent.vertices[0].normal, [-half, 0.0, half]);
    }

    #[test]
    fn an_edge_between_two_tags_splits_its_vertices() {
        let shading = shaded([0, 1, 1, 1], 100.0);
        assert_eq!(shading.vertices.len(), 8);
        assert_eq!(shading.vertices[0].tag, 0);
        assert_near(shading.vertices[0].normal, [0.0, 0.0, 1.0]);
        assert_eq!(shading.corners[..6], [0, 1, 2, 3, 4, 5]);
    }
}
