//! Joining of the squares' patches to one plane.

use super::super::domain::Domain;
use super::super::observer::Pace;
use super::super::request::WorkspaceError;
use super::patch::{Patch, Rim, Set, Table, Triangle, Vertex, key};
use super::site::Site;
use super::{Lattice, Plane};

pub(super) fn join(
    domain: &Domain<'_>,
    lattice: &Lattice,
    patches: Vec<Patch>,
    pace: &mut Pace<'_>,
) -> Result<Plane, WorkspaceError> {
    let total: usize = patches.iter().map(|patch| patch.vertices.len()).sum();
    // Two sheets' vertices, and those that are added, must be numbered by 32 bits.
    if u32::try_from(total.saturating_mul(4)).is_err() {
        return Err(WorkspaceError::TooFine);
    }
    let mut vertices: Vec<Vertex> = Vec::with_capacity(total);
    let (mut triangles, mut rims) = (Vec::new(), Vec::new());
    let mut shared = Table::default();
    for patch in patches {
        let mut numbers = Vec::with_capacity(patch.vertices.len());
        for vertex in patch.vertices {
            pace.step()?;
            let next = number(vertices.len());
            let found =
                if lattice.shared(vertex.at) { *shared.entry(key(vertex.at)).or_insert(next) } else { next };
            if found == next {
                vertices.push(vertex);
            }
            numbers.push(found);
        }
        let place = |n: u32| numbers[n as usize];
        for triangle in patch.triangles {
            pace.step()?;
            triangles.push(Triangle { corners: triangle.corners.map(place), ..triangle });
        }
        for rim in patch.rims {
            pace.step()?;
            rims.push(Rim { ends: rim.ends.map(place), ..rim });
        }
    }
    let mut plane = Plane { vertices, triangles, rims: outer(rims, pace)? };
    plane.part_sheets(domain, pace)?;
    Ok(plane)
}

fn number(n: usize) -> u32 {
    u32::try_from(n).unwrap_or(u32::MAX)
}

/// The sides with the domain on their left only.
fn outer(rims: Vec<Rim>, pace: &mut Pace<'_>) -> Result<Vec<Rim>, WorkspaceError> {
    let directed = directed(&rims, pace)?;
    let mut outer = Vec::new();
    for rim in rims {
        pace.step()?;
        let [a, b] = rim.ends;
        if !directed.contains(&[b, a]) {
            outer.push(rim);
        }
    }
    Ok(outer)
}

fn directed(rims: &[Rim], pace: &mut Pace<'_>) -> Result<Set<[u32; 2]>, WorkspaceError> {
    let mut directed = Set::default();
    for rim in rims {
        pace.step()?;
        directed.insert(rim.ends);
    }
    Ok(directed)
}

impl Plane {
    /// Halves inner edges between two points at which the sheets meet: such an edge would belong to both sheets. The
    /// middle becomes a vertex of each sheet.
    fn part_sheets(&mut self, domain: &Domain<'_>, pace: &mut Pace<'_>) -> Result<(), WorkspaceError> {
        let rims = directed(&self.rims, pace)?;
        let mut middles: Table<[u32; 2], u32> = Table::default();
        let mut numbers: Vec<usize> = (0..self.triangles.len()).collect();
        // A triangle may have several such edges, so its parts are examined again.
        while let Some(which) = numbers.pop() {
            pace.step()?;
            let corners = self.triangles[which].corners;
            let side = (0..3).find(|&i| {
                let ends = [corners[i], corners[(i + 1) % 3]];
                ends.iter().all(|&end| self.vertices[end as usize].pinched) && !rims.contains(&ends)
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
            let sliders = self.triangles[which].sliders;
            self.triangles[which].corners = [a, middle, c];
            self.triangles.push(Triangle { corners: [middle, b, c], sliders });
            numbers.extend([which, self.triangles.len() - 1]);
        }
        Ok(())
    }

    fn between(&self, domain: &Domain<'_>, a: u32, b: u32) -> Vertex {
        let (a, b) = (self.vertices[a.min(b) as usize].at, self.vertices[a.max(b) as usize].at);
        let at = [0, 1].map(|axis| 0.5 * (a[axis] + b[axis]));
        let site = Site::new(domain, at);
        Vertex { at, ends: site.ends(domain), pinched: false }
    }
}
