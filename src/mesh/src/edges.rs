//! The edges of a mesh, and the triangles at each.

use crate::Mesh;

/// One triangle's side. The corners of triangle t are numbered 3t, 3t + 1, 3t + 2; the side runs from
/// `corner` to the triangle's next one.
#[derive(Clone, Copy)]
pub(crate) struct Side {
    /// The two vertices, the lesser in the upper half, so that both triangles at an edge give the same
    /// number.
    edge: u64,
    /// The corner it starts from.
    pub(crate) corner: u32,
    /// True if it runs from the lesser vertex to the greater.
    pub(crate) rising: bool,
}

impl Side {
    /// The triangle it belongs to.
    pub(crate) fn triangle(self) -> usize {
        self.corner as usize / 3
    }

    /// The corner it ends at.
    pub(crate) fn next(self) -> u32 {
        next_corner(self.corner)
    }

    /// The corners it has at the lesser and at the greater vertex.
    pub(crate) fn ends(self) -> [u32; 2] {
        if self.rising { [self.corner, self.next()] } else { [self.next(), self.corner] }
    }
}

/// The sides of a mesh. Those of one edge are contiguous.
pub(crate) struct Edges(Vec<Side>);

impl Edges {
    /// All sides of a mesh, sorted by edge and then by corner.
    pub(crate) fn of(mesh: &Mesh) -> Self {
        Self::among(mesh, |_, _| true)
    }

    /// The sides whose two vertices satisfy a predicate.
    pub(crate) fn among(mesh: &Mesh, wanted: impl Fn(u32, u32) -> bool) -> Self {
        let mut sides = Vec::new();
        for corner in 0..mesh.corner_count() {
            let [from, to] = mesh.side(corner);
            if wanted(from, to) {
                let edge = u64::from(from.min(to)) << 32 | u64::from(from.max(to));
                sides.push(Side { edge, corner, rising: from < to });
            }
        }
        sides.sort_unstable_by_key(|side| (side.edge, side.corner));
        Self(sides)
    }

    /// The edges, each as the sides that lie on it.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &[Side]> {
        self.0.chunk_by(|a, b| a.edge == b.edge)
    }
}

impl Mesh {
    /// The number of the triangles' corners. `Mesh::new` checked that it fits.
    pub(crate) fn corner_count(&self) -> u32 {
        u32::try_from(self.triangles().len() * 3).unwrap_or(u32::MAX)
    }

    /// The two vertices of the side that starts from a corner.
    pub(crate) fn side(&self, corner: u32) -> [u32; 2] {
        [corner, next_corner(corner)].map(|end| self.triangles().as_flattened()[end as usize])
    }
}

/// The corner after this one in its triangle.
fn next_corner(corner: u32) -> u32 {
    if corner % 3 == 2 { corner - 2 } else { corner + 1 }
}
