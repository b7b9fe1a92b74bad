//! Triangles and boundary sides of the faces into which a triangle was cut.

use super::ear_clipping::triangulate;
use super::fast_hash::FastSet;
use super::mesh::{BoundarySide, PlaneTriangle};
use super::patch::Patch;
use super::sample::{CREASES, Sample, TABLE_CREASES};
use super::triangle_cut::{Face, TriangleCut};
use crate::workspace::domain::{ColumnEnd, Limit};
use crate::workspace::observer::StepCounter;
use crate::workspace::request::WorkspaceError;

impl TriangleCut<'_> {
    /// Adds triangles and boundary sides of all faces to the patch.
    pub(super) fn add_to(&self, patch: &mut Patch) -> Result<(), WorkspaceError> {
        let mut steps = StepCounter::new(self.triangle.observer);
        let mut outlines = Vec::with_capacity(self.faces.len());
        for face in &self.faces {
            let mut face = self.with_divisions(face);
            let vertex = |&sample: &usize| patch.vertex(self.triangle.domain, &self.triangle.samples[sample]);
            let mut numbers: Vec<u32> = face.iter().map(vertex).collect();
            let mut limits = self.limits(&face);
            without_spikes(&mut face, &mut numbers, &mut limits);
            for (ends, limit) in sides(&numbers).zip(&limits) {
                patch.mesh.boundary.extend(limit.map(|limit| BoundarySide { ends, limit }));
            }
            outlines.push((face, numbers));
        }
        // If all faces are triangles already, the edges elsewhere do not matter.
        let cuts = outlines.iter().any(|(_, numbers)| numbers.len() > 3);
        let mut edges: FastSet<[u32; 2]> = FastSet::default();
        if cuts {
            edges.extend(outlines.iter().flat_map(|(_, numbers)| sides(numbers)));
        }
        for (face, numbers) in outlines {
            let column_ends = self.column_ends(&face);
            let samples: Vec<&Sample> = face.iter().map(|&sample| &self.triangle.samples[sample]).collect();
            let is_edge = |i: usize, j: usize| {
                let (a, b) = (numbers[i], numbers[j]);
                edges.contains(&[a, b]) || edges.contains(&[b, a])
            };
            for ear in triangulate(&samples, is_edge, &mut steps)? {
                let corners = ear.map(|i| numbers[i]);
                patch.mesh.triangles.push(PlaneTriangle { corners, column_ends });
                if cuts {
                    edges.extend(sides(&corners));
                }
            }
        }
        Ok(())
    }

    /// The limit on which each side of a face lies, if on any.
    fn limits(&self, face: &[usize]) -> Vec<Option<Limit>> {
        let next = face.iter().cycle().skip(1);
        let on = |&sample: &usize| self.triangle.samples[sample].on();
        let limit = |(a, b)| Limit::ALL.get((on(a) & on(b)).trailing_zeros() as usize).copied();
        face.iter().zip(next).map(limit).collect()
    }

    /// What bounds the columns over a face below and above.
    fn column_ends(&self, face: &[usize]) -> [ColumnEnd; 2] {
        [(CREASES, TABLE_CREASES), (CREASES + 2, TABLE_CREASES + 1)].map(|(first, table)| {
            let curves = [table, first, first + 1];
            let ends = [ColumnEnd::Table, ColumnEnd::Slider(0), ColumnEnd::Slider(1)];
            let bound = curves.iter().position(|&curve| self.triangle.side(curve, face) > 0.0);
            bound.map_or(ColumnEnd::Slider(2), |bound| ends[bound])
        })
    }
}

/// The sides of a ring of vertices.
fn sides(ring: &[u32]) -> impl Iterator<Item = [u32; 2]> + '_ {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(&a, &b)| [a, b])
}

/// Removes points that coincide with their neighbours, and sides that go forth and back. The remaining sides keep
/// their limits, whichever of the coinciding points stays.
fn without_spikes(face: &mut Face, numbers: &mut Vec<u32>, limits: &mut Vec<Option<Limit>>) {
    let mut i = 0;
    while i < numbers.len() && numbers.len() > 2 {
        let count = numbers.len();
        let (before, after) = (numbers[(i + count - 1) % count], numbers[(i + 1) % count]);
        if numbers[i] == after || before == after {
            face.remove(i);
            numbers.remove(i);
            limits.remove(i);
            i = 0;
        } else {
            i += 1;
        }
    }
    if numbers.len() < 3 {
        face.clear();
        numbers.clear();
        limits.clear();
    }
}
