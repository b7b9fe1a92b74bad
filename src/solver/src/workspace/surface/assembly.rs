//! Assembly of a surface: two sheets over the triangles of the plane, and walls over its boundary.

use super::mesh::Surface;
use crate::pose::Point;
use crate::workspace::domain::{Binding, Domain};
use crate::workspace::observer::StepCounter;
use crate::workspace::plane::{BoundarySide, PlaneMesh};
use crate::workspace::request::WorkspaceError;
use crate::workspace::vector::{dot, minus};

impl Surface {
    /// The surface over a mesh of the plane domain. It may touch itself.
    pub(super) fn over(
        domain: &Domain<'_>,
        plane: &PlaneMesh,
        steps: &mut StepCounter<'_>,
    ) -> Result<Self, WorkspaceError> {
        let mut surface = Self::default();
        let count = plane.surface_triangles();
        surface.triangles.reserve_exact(count);
        surface.bindings.reserve_exact(count);
        let sheets = surface.vertices(plane, steps)?;
        for triangle in &plane.triangles {
            steps.step()?;
            let [a, b, c] = triangle.corners.map(|corner| sheets[corner as usize]);
            surface.add([a[0], c[0], b[0]], domain.sheet_binding(triangle.column_ends[0], false));
            surface.add([a[1], b[1], c[1]], domain.sheet_binding(triangle.column_ends[1], true));
        }
        for side in &plane.boundary {
            steps.step()?;
            surface.wall(domain, plane, side, side.ends.map(|end| sheets[end as usize]));
        }
        Ok(surface)
    }

    /// Numbers of each plane vertex's lower and upper position.
    fn vertices(
        &mut self,
        plane: &PlaneMesh,
        steps: &mut StepCounter<'_>,
    ) -> Result<Vec<[u32; 2]>, WorkspaceError> {
        self.positions.reserve_exact(2 * plane.vertices.len());
        let mut sheets = Vec::with_capacity(plane.vertices.len());
        for vertex in &plane.vertices {
            steps.step()?;
            let low = u32::try_from(self.positions.len()).unwrap_or(u32::MAX);
            self.positions.push(vertex.ends[0]);
            if !vertex.pinched {
                self.positions.push(vertex.ends[1]);
            }
            sheets.push([low, low + u32::from(!vertex.pinched)]);
        }
        Ok(sheets)
    }

    /// Adds the wall over a side, split by the shorter of its diagonals. If it stems from rod interference, its
    /// binding names the two rods that are nearest half-way along the side.
    fn wall(&mut self, domain: &Domain<'_>, plane: &PlaneMesh, side: &BoundarySide, [a, b]: [[u32; 2]; 2]) {
        let [from, to] = side.ends.map(|end| plane.vertices[end as usize].at);
        let limit = domain.binding_at(side.limit, [0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1])]);
        let ends = side.ends.map(|end| plane.vertices[end as usize].ends);
        let square = |p: Point, q: Point| dot(minus(p, q), minus(p, q));
        if a[0] == a[1] || b[0] == b[1] || square(ends[0][0], ends[1][1]) <= square(ends[1][0], ends[0][1]) {
            self.add([a[0], b[0], b[1]], limit);
            self.add([a[0], b[1], a[1]], limit);
        } else {
            self.add([a[0], b[0], a[1]], limit);
            self.add([b[0], b[1], a[1]], limit);
        }
    }

    fn add(&mut self, [a, b, c]: [u32; 3], binding: Binding) {
        if a != b && b != c && c != a {
            self.triangles.push([a, b, c]);
            self.bindings.push(binding);
        }
    }
}
