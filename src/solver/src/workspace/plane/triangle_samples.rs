//! The samples of a triangle that is being cut.

use super::sample::Sample;
use crate::workspace::domain::Domain;
use crate::workspace::observer::Observer;

/// A triangle's samples: the three corners, and then the points at which curves cut it. Other code names a sample by
/// its number.
pub(super) struct TriangleSamples<'a> {
    pub(super) domain: &'a Domain<'a>,
    pub(super) tolerance: f64,
    pub(super) observer: &'a dyn Observer,
    pub(super) samples: Vec<Sample>,
}

impl TriangleSamples<'_> {
    /// Adds a sample and returns its number.
    pub(super) fn add(&mut self, sample: Sample) -> usize {
        self.samples.push(sample);
        self.samples.len() - 1
    }

    /// A curve's function at a sample.
    pub(super) fn value(&self, sample: usize, curve: usize) -> f64 {
        self.samples[sample].values[curve]
    }

    /// The sign of a curve's function on a face that the curve does not cut.
    pub(super) fn side(&self, curve: usize, face: &[usize]) -> f64 {
        let values = face.iter().map(|&sample| self.value(sample, curve));
        values.fold(0.0, |most: f64, value| if value.abs() > most.abs() { value } else { most })
    }

    /// Whether a point is inside the triangle.
    pub(super) fn contains(&self, [x, y]: [f64; 2]) -> bool {
        (0..3).all(|i| {
            let ([ax, ay], [bx, by]) = (self.samples[i].at(), self.samples[(i + 1) % 3].at());
            let (dx, dy) = (bx - ax, by - ay);
            dx * (y - ay) - dy * (x - ax) > 1e-9 * (dx * dx + dy * dy)
        })
    }
}
