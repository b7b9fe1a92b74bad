//! Examination of a mesh: is it a closed surface?

use crate::edges::{Edges, Side};
use crate::union_find::UnionFind;
use crate::{Mesh, facet};

/// The defects of a mesh, and its topology.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Audit {
    /// Edges of only one triangle. The surface has a boundary there.
    pub boundary_edges: usize,
    /// Edges of more than two triangles.
    pub non_manifold_edges: usize,
    /// Edges whose two triangles face opposite ways.
    pub inconsistent_edges: usize,
    /// Triangles whose corners lie on a line.
    pub degenerate_triangles: usize,
    /// Vertices at which several fans of triangles touch without sharing an edge.
    pub pinched_vertices: usize,
    /// Vertices less edges plus triangles.
    pub euler_characteristic: i64,
    /// Connected components: parts of the surface that share no edge with each other.
    pub components: usize,
}

impl Audit {
    /// Whether the surface separates an inside from an outside everywhere: every edge has two triangles, and these face
    /// the same way.
    ///
    /// # Examples
    ///
    /// ```
    #[doc = include_str!("doctest/tetrahedron.md")]
    /// assert!(mesh.audit().is_watertight());
    /// # Ok::<(), MeshError>(())
    /// ```
    pub fn is_watertight(&self) -> bool {
        self.boundary_edges == 0 && self.non_manifold_edges == 0 && self.inconsistent_edges == 0
    }
}

impl Mesh {
    /// Examines the mesh. All counts follow from the indices, except that of degenerate triangles, which needs
    /// coordinates.
    ///
    /// # References
    ///
    /// Euler's polyhedron formula: vertices - edges + triangles = 2 for a sphere, 0 for a torus.
    ///
    /// # Examples
    ///
    /// ```
    #[doc = include_str!("doctest/tetrahedron.md")]
    /// let audit = mesh.audit();
    /// assert_eq!((audit.boundary_edges, audit.components, audit.euler_characteristic), (0, 1, 2));
    /// # Ok::<(), MeshError>(())
    /// ```
    pub fn audit(&self) -> Audit {
        let mut audit = Audit::default();
        let mut components = UnionFind::new(self.corner_count() / 3);
        let mut fans = UnionFind::new(self.corner_count());
        let mut edges: usize = 0;
        for sides in Edges::of(self).iter() {
            edges += 1;
            audit.count_edge(sides);
            for pair in sides.windows(2) {
                components.union(pair[0].corner / 3, pair[1].corner / 3);
                fans.union(pair[0].ends()[0], pair[1].ends()[0]);
                fans.union(pair[0].ends()[1], pair[1].ends()[1]);
            }
        }
        audit.components = components.count();
        audit.pinched_vertices = self.pinched_vertices(&mut fans);
        audit.degenerate_triangles = self
            .triangles()
            .iter()
            .filter(|triangle| facet::normal(self.corners(triangle)).is_none())
            .count();
        audit.euler_characteristic = signed(self.positions().len() + self.triangles().len()) - signed(edges);
        audit
    }

    /// Counts the vertices with corners in more than one fan.
    fn pinched_vertices(&self, fans: &mut UnionFind) -> usize {
        let mut first: Vec<Option<u32>> = vec![None; self.positions().len()];
        let mut pinched = vec![false; self.positions().len()];
        for (corner, &vertex) in (0..).zip(self.triangles().as_flattened()) {
            let (fan, vertex) = (fans.find(corner), vertex as usize);
            pinched[vertex] |= *first[vertex].get_or_insert(fan) != fan;
        }
        pinched.into_iter().filter(|&several| several).count()
    }
}

impl Audit {
    fn count_edge(&mut self, sides: &[Side]) {
        match sides {
            [_] => self.boundary_edges += 1,
            [a, b] => self.inconsistent_edges += usize::from(a.rising == b.rising),
            _ => self.non_manifold_edges += 1,
        }
    }
}

/// Counts are below 2³⁴: the indices have 32 bits.
fn signed(count: usize) -> i64 {
    i64::try_from(count).unwrap_or(i64::MAX)
}
