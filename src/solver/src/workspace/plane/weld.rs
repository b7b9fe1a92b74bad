//! Welding of the squares' patches to one mesh: common points become one vertex.

use super::fast_hash::{FastMap, FastSet, point_key};
use super::lattice::Lattice;
use super::mesh::{BoundarySide, PlaneMesh, PlaneTriangle, PlaneVertex};
use super::patch::Patch;
use super::sample::Sample;
use crate::workspace::domain::Domain;
use crate::workspace::observer::StepCounter;
use crate::workspace::request::WorkspaceError;

pub(super) fn weld(
    domain: &Domain<'_>,
    lattice: &Lattice,
    patches: Vec<Patch>,
    steps: &mut StepCounter<'_>,
) -> Result<PlaneMesh, WorkspaceError> {
    let total: usize = patches.iter().map(|patch| patch.mesh.vertices.len()).sum();
    // Two sheets' vertices, and those that are added, must be numbered by 32 bits.
    if u32::try_from(total.saturating_mul(4)).is_err() {
        return Err(WorkspaceError::TooFine);
    }
    let mut vertices: Vec<PlaneVertex> = Vec::with_capacity(total);
    let (mut triangles, mut boundary) = (Vec::new(), Vec::new());
    let mut shared = FastMap::default();
    for Patch { mesh: patch, .. } in patches {
        let mut numbers = Vec::with_capacity(patch.vertices.len());
        for vertex in patch.vertices {
            steps.step()?;
            let next = number(vertices.len());
            let on_lattice = lattice.shared(vertex.at);
            let found = if on_lattice { *shared.entry(point_key(vertex.at)).or_insert(next) } else { next };
            if found == next {
                vertices.push(vertex);
            }
            numbers.push(found);
        }
        let welded = |n: u32| numbers[n as usize];
        for triangle in patch.triangles {
            steps.step()?;
            triangles.push(PlaneTriangle { corners: triangle.corners.map(welded), ..triangle });
        }
        for side in patch.boundary {
            steps.step()?;
            boundary.push(BoundarySide { ends: side.ends.map(welded), ..side });
        }
    }
    let mut mesh = PlaneMesh { vertices, triangles, boundary: outer(boundary, steps)? };
    mesh.separate_sheets(domain, steps)?;
    Ok(mesh)
}

fn number(n: usize) -> u32 {
    u32::try_from(n).unwrap_or(u32::MAX)
}

/// The sides with the domain on their left only.
fn outer(
    boundary: Vec<BoundarySide>,
    steps: &mut StepCounter<'_>,
) -> Result<Vec<BoundarySide>, WorkspaceError> {
    let directed = directed(&boundary, steps)?;
    let mut outer = Vec::new();
    for side in boundary {
        steps.step()?;
        let [a, b] = side.ends;
        if !directed.contains(&[b, a]) {
            outer.push(side);
        }
    }
    Ok(outer)
}

fn directed(
    boundary: &[BoundarySide],
    steps: &mut StepCounter<'_>,
) -> Result<FastSet<[u32; 2]>, WorkspaceError> {
    let mut directed = FastSet::default();
    for side in boundary {
        steps.step()?;
        directed.insert(side.ends);
    }
    Ok(directed)
}

impl PlaneMesh {
    /// Halves inner edges between two points at which the sheets meet: such an edge would belong to both sheets. The
    /// middle becomes a vertex of each sheet.
    fn separate_sheets(
        &mut self,
        domain: &Domain<'_>,
        steps: &mut StepCounter<'_>,
    ) -> Result<(), WorkspaceError> {
        let boundary = directed(&self.boundary, steps)?;
        let mut middles: FastMap<[u32; 2], u32> = FastMap::default();
        let mut numbers: Vec<usize> = (0..self.triangles.len()).collect();
        // A triangle may have several such edges, so its halves are examined again.
        while let Some(which) = numbers.pop() {
            steps.step()?;
            let corners = self.triangles[which].corners;
            let side = (0..3).find(|&i| {
                let ends = [corners[i], corners[(i + 1) % 3]];
                ends.iter().all(|&end| self.vertices[end as usize].pinched) && !boundary.contains(&ends)
            });
            let Some(i) = side else { continue };
            let [a, b, c] = [0, 1, 2].map(|n| corners[(i + n) % 3]);
            let middle = if let Some(&middle) = middles.get(&[a.min(b), a.max(b)]) {
                middle
            } else {
                let middle = number(self.vertices.len());
                self.vertices.push(self.between(domain, a, b));
                middles.insert([a.min(b), a.max(b)], middle);
                middle
            };
            let half = PlaneTriangle { corners: [middle, b, c], ..self.triangles[which] };
            self.triangles[which].corners = [a, middle, c];
            self.triangles.push(half);
            numbers.extend([which, self.triangles.len() - 1]);
        }
        Ok(())
    }

    fn between(&self, domain: &Domain<'_>, a: u32, b: u32) -> PlaneVertex {
        let (a, b) = (self.vertices[a.min(b) as usize].at, self.vertices[a.max(b) as usize].at);
        let at = [0, 1].map(|axis| 0.5 * (a[axis] + b[axis]));
        let sample = Sample::new(domain, at);
        PlaneVertex { at, ends: sample.ends(domain), pinched: false }
    }
}
