//! Examination of a mesh: is it a closed surface?

use crate::edges::{Edges, Side};
use crate::forest::Forest;
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
    /// Pieces of the surface that share no edge with each other.
    pub components: usize,
}

impl Audit {
    /// Whether the surface separates an inside from an outside everywhere: every edge has two triangles, and these face
    /// the same way.
    ///
    /// # Examples
    ///
    /// ```
    /// # use verne_mesh::{Mesh, MeshFault, Swatch};
    /// # fn tetrahedron() -> Result<Mesh, MeshFault> {
    /// #     let corners = vec![[0.0, 0.0, 0.0], [6.0, 0.0, 0.0], [0.0, 6.0, 0.0], [0.0, 0.0, 6.0]];
    /// #     let triangles = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
    /// #     let palette = ["walls", "slope"].map(|name| Swatch { name: name.to_owned(), rgb: [80, 80, 80] });
    /// #     Mesh::new(corners, triangles, vec![0, 0, 1, 0], palette.to_vec())
    /// # }
    /// let mesh = tetrahedron()?; // corners at the origin and at 6 mm on each axis
    /// assert!(mesh.audit().is_watertight());
    /// # Ok::<(), MeshFault>(())
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
    /// # use verne_mesh::{Mesh, MeshFault, Swatch};
    /// # fn tetrahedron() -> Result<Mesh, MeshFault> {
    /// #     let corners = vec![[0.0, 0.0, 0.0], [6.0, 0.0, 0.0], [0.0, 6.0, 0.0], [0.0, 0.0, 6.0]];
    /// #     let triangles = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
    /// #     let palette = ["walls", "slope"].map(|name| Swatch { name: name.to_owned(), rgb: [80, 80, 80] });
    /// #     Mesh::new(corners, triangles, vec![0, 0, 1, 0], palette.to_vec())
    /// # }
    /// let mesh = tetrahedron()?; // corners at the origin and at 6 mm on each axis
    /// let audit = mesh.audit();
    /// assert_eq!((audit.boundary_edges, audit.components, audit.euler_characteristic), (0, 1, 2));
    /// # Ok::<(), MeshFault>(())
    /// ```
    pub fn audit(&self) -> Audit {
        let mut audit = Audit::default();
        let mut pieces = Forest::new(self.corner_count() / 3);
        let mut fans = Forest::new(self.corner_count());
        let mut edges: usize = 0;
        for sides in Edges::of(self).iter() {
            edges += 1;
            audit.judge(sides);
            for pair in sides.windows(2) {
                pieces.join(pair[0].corner / 3, pair[1].corner / 3);
                fans.join(pair[0].ends()[0], pair[1].ends()[0]);
                fans.join(pair[0].ends()[1], pair[1].ends()[1]);
            }
        }
        audit.components = pieces.count();
        audit.pinched_vertices = self.pinched(&mut fans);
        audit.degenerate_triangles = self
            .triangles()
            .iter()
            .filter(|triangle| facet::normal(self.corners(triangle)).is_none())
            .count();
        audit.euler_characteristic = signed(self.positions().len() + self.triangles().len()) - signed(edges);
        audit
    }

    /// Counts the vertices with corners in more than one fan.
    fn pinched(&self, fans: &mut Forest) -> usize {
        let mut first = vec![u32::MAX; self.positions().len()];
        let mut pinched = vec![false; self.positions().len()];
        for (corner, &vertex) in (0..).zip(self.triangles().as_flattened()) {
            let (fan, vertex) = (fans.root(corner), vertex as usize);
            if first[vertex] == u32::MAX {
                first[vertex] = fan;
            }
            pinched[vertex] |= first[vertex] != fan;
        }
        pinched.into_iter().filter(|&several| several).count()
    }
}

impl Audit {
    fn judge(&mut self, sides: &[Side]) {
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
