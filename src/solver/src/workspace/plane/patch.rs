//! The triangles of one square of the lattice.

use super::fast_hash::{FastMap, PointKey, point_key};
use super::mesh::{PlaneMesh, PlaneVertex};
use super::sample::Sample;
use crate::workspace::domain::Domain;

/// The mesh of one square. A boundary side that occurs in both directions is inside the domain.
#[derive(Default)]
pub(super) struct Patch {
    pub(super) mesh: PlaneMesh,
    numbers: FastMap<PointKey, u32>,
    /// Midpoints of edges that occurred once, stored for the triangle on the other side.
    middles: FastMap<PointKey, Sample>,
}

impl Patch {
    pub(super) fn middle(&mut self, domain: &Domain<'_>, a: &Sample, b: &Sample) -> Sample {
        let ([ax, ay], [bx, by]) = (a.at(), b.at());
        let at = [0.5 * (ax + bx), 0.5 * (ay + by)];
        if let Some(sample) = self.middles.remove(&point_key(at)) {
            return sample;
        }
        let sample = Sample::new(domain, at);
        self.middles.insert(point_key(at), sample.clone());
        sample
    }

    /// Discards the data that only the cutting needs.
    pub(super) fn finish(&mut self) {
        self.numbers = FastMap::default();
        self.middles = FastMap::default();
    }

    /// The number of the vertex at a sample.
    pub(super) fn vertex(&mut self, domain: &Domain<'_>, sample: &Sample) -> u32 {
        let next = u32::try_from(self.mesh.vertices.len()).unwrap_or(u32::MAX);
        let number = *self.numbers.entry(point_key(sample.at())).or_insert(next);
        if number == next {
            self.mesh.vertices.push(PlaneVertex {
                at: sample.at(),
                ends: sample.ends(domain),
                pinched: !domain.flat() && sample.pinched(),
            });
        }
        number
    }
}
