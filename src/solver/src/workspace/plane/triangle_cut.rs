//! The cut of a triangle that is simple and flat enough, along the curves that cross it.
//!
//! First the limits cut, and the outside is discarded. Then the creases cut, and both sides stay. A new point on an
//! edge of the triangle follows from that edge alone, and the signs of all curves along the edge follow from its
//! ends. So the triangle on the other side is cut alike.

use super::curve_refinement::{between, on_curve};
use super::sample::{CREASES, CURVES, Sample, TABLE_CREASES, value};
use super::triangle_samples::TriangleSamples;
use crate::workspace::domain::{Domain, LIMITS};
use crate::workspace::observer::{Observer, check_cancelled, count};
use crate::workspace::request::WorkspaceError;
use crate::workspace::root;

/// Resolution of a point on an edge, as a fraction of the edge.
const RESOLUTION: f64 = 1e-12;

/// Difference of heights, in units of the machine, below which they are the same where two curves meet.
const SAME: f64 = 1e-9;

/// A polygon by the numbers of its samples, counter-clockwise.
pub(super) type Face = Vec<usize>;

/// A triangle while it is cut.
pub(super) struct TriangleCut<'a> {
    pub(super) triangle: TriangleSamples<'a>,
    pub(super) faces: Vec<Face>,
    /// Sides that were divided: the two ends, in order, and the point between.
    divided: Vec<([usize; 2], usize)>,
}

impl<'a> TriangleCut<'a> {
    /// A triangle with further points on its edges, in order.
    pub(super) fn new(
        domain: &'a Domain<'a>,
        tolerance: f64,
        observer: &'a dyn Observer,
        corners: [&Sample; 3],
        points: [Vec<Sample>; 3],
    ) -> Self {
        let mut samples: Vec<Sample> = corners.into_iter().cloned().collect();
        for (sample, border) in samples.iter_mut().zip([0b101, 0b011, 0b110]) {
            sample.border = border;
        }
        let mut face = Face::new();
        for (edge, points) in points.into_iter().enumerate() {
            face.push(edge);
            for point in points {
                face.push(samples.len());
                samples.push(Sample { border: 1 << edge, ..point });
            }
        }
        let triangle = TriangleSamples { domain, tolerance, observer, samples };
        Self { triangle, faces: vec![face], divided: Vec::new() }
    }

    /// Cuts the triangle along all limits, and what is left along all creases.
    pub(super) fn cut_all(&mut self) -> Result<(), WorkspaceError> {
        check_cancelled(self.triangle.observer)?;
        for limit in 0..LIMITS {
            self.cut(limit, false)?;
        }
        if self.faces.is_empty() {
            return Ok(());
        }
        if self.triangle.domain.table_bounds_columns() {
            self.cut(TABLE_CREASES, true)?;
            self.cut(TABLE_CREASES + 1, true)?;
        }
        if !self.triangle.domain.flat() {
            for crease in CREASES..TABLE_CREASES {
                self.cut(crease, true)?;
            }
        }
        Ok(())
    }

    /// Cuts all faces along a curve. It discards the negative side unless `both` sides stay.
    fn cut(&mut self, curve: usize, both: bool) -> Result<(), WorkspaceError> {
        // A sheet's creases end where the table begins to bind. The second one also ends at the first, where slider 1
        // begins to bind.
        let crease = (CREASES..TABLE_CREASES).contains(&curve).then(|| curve - CREASES);
        let before = [
            crease.map(|crease| TABLE_CREASES + crease / 2),
            crease.filter(|crease| crease % 2 == 1).map(|_| curve - 1),
        ];
        let mut faces = Vec::with_capacity(self.faces.len());
        for face in std::mem::take(&mut self.faces) {
            let face = if both { self.with_divisions(&face) } else { face };
            let elsewhere = before.into_iter().flatten().any(|other| self.triangle.side(other, &face) >= 0.0);
            if elsewhere || !face.iter().any(|&sample| self.triangle.value(sample, curve) < 0.0) {
                faces.push(face);
            } else if face.iter().any(|&sample| self.triangle.value(sample, curve) > 0.0) {
                self.divide(curve, &face, both, &mut faces)?;
            } else if both {
                faces.push(face);
            }
        }
        self.faces = faces;
        Ok(())
    }

    /// Divides a face along a curve that crosses it.
    fn divide(
        &mut self,
        curve: usize,
        face: &[usize],
        both: bool,
        faces: &mut Vec<Face>,
    ) -> Result<(), WorkspaceError> {
        let mut ring = Face::with_capacity(face.len() + 4);
        for (i, &a) in face.iter().enumerate() {
            let b = face[(i + 1) % face.len()];
            ring.push(a);
            // The product of the values is not used, because it may underflow to zero.
            let [first, last] = [a, b].map(|sample| self.triangle.value(sample, curve));
            if first < 0.0 && last > 0.0 || first > 0.0 && last < 0.0 {
                ring.push(self.crossing(curve, a, b));
            }
        }
        let joined = self.joined(curve, &ring);
        let [inner, cut_off] = self.split(curve, &ring, joined)?;
        // The faces cut off are negative if the positive side is joined, and positive otherwise.
        let (positive, negative) = if joined { (inner, cut_off) } else { (cut_off, inner) };
        faces.extend(positive);
        if both {
            faces.extend(negative);
        }
        Ok(())
    }

    /// Whether the positive regions of a ring are connected between several negative ones.
    fn joined(&self, curve: usize, ring: &[usize]) -> bool {
        let zeros: Vec<[f64; 2]> = ring
            .iter()
            .filter(|&&sample| self.triangle.value(sample, curve) == 0.0)
            .map(|&sample| self.triangle.samples[sample].at())
            .collect();
        if zeros.len() <= 2 {
            return true;
        }
        let weight = 1.0 / count(zeros.len());
        let centre = [0, 1].map(|axis| zeros.iter().map(|zero| zero[axis]).sum::<f64>() * weight);
        value(self.triangle.domain, curve, &self.triangle.domain.column(centre)) >= 0.0
    }

    /// Cuts off the runs of one sign: the negative ones if the positive side is `joined`. Returns the remainder, if
    /// it has an area, and the faces cut off.
    fn split(
        &mut self,
        curve: usize,
        ring: &[usize],
        joined: bool,
    ) -> Result<[Vec<Face>; 2], WorkspaceError> {
        let sign = if joined { -1.0 } else { 1.0 };
        let off = |cut: &Self, sample: usize| cut.triangle.value(sample, curve) * sign > 0.0;
        let count = ring.len();
        let mut rest = Face::with_capacity(count);
        let mut cut_off = Vec::new();
        // Begin where the ring is not cut off.
        let Some(start) = (0..count).find(|&i| !off(self, ring[i])) else {
            return Ok([Vec::new(), vec![ring.to_vec()]]);
        };
        let mut run = Face::new();
        for step in 1..=count {
            let (before, sample) = (ring[(start + step - 1) % count], ring[(start + step) % count]);
            if off(self, sample) {
                if run.is_empty() {
                    run.push(before);
                }
                run.push(sample);
                continue;
            }
            if !run.is_empty() {
                let from = run[0];
                run.push(sample);
                if from == sample {
                    // The curve only touches the ring here.
                    return Ok([Vec::new(), vec![ring.to_vec()]]);
                }
                let bent = between(&mut self.triangle, curve, from, sample)?;
                rest.extend(&bent);
                run.extend(bent.iter().rev());
                cut_off.push(std::mem::take(&mut run));
            }
            rest.push(sample);
        }
        let other = rest.iter().any(|&sample| self.triangle.value(sample, curve) * sign < 0.0);
        let area = rest.len() >= 3 && (other || rest.iter().any(|sample| !ring.contains(sample)));
        Ok(if area { [vec![rest], cut_off] } else { [Vec::new(), vec![ring.to_vec()]] })
    }

    /// The point at which a curve crosses a side.
    fn crossing(&mut self, curve: usize, a: usize, b: usize) -> usize {
        let (a, b) =
            if self.triangle.samples[b].precedes(&self.triangle.samples[a]) { (b, a) } else { (a, b) };
        if let Some((_, between)) = self.divided.iter().find(|(ends, _)| *ends == [a, b]) {
            return *between;
        }
        let (first, last) = (self.triangle.samples[a].clone(), self.triangle.samples[b].clone());
        let border = first.border & last.border;
        let along = first.on() & last.on();
        let sample = if border == 0 && along != 0 {
            self.junction(curve, along.trailing_zeros() as usize, &first, &last)
        } else {
            self.on_segment(curve, &first, &last, border)
        };
        let between = self.triangle.add(sample);
        self.divided.push(([a, b], between));
        between
    }

    fn on_segment(&self, curve: usize, a: &Sample, b: &Sample, border: u8) -> Sample {
        let at = |fraction: f64| {
            let ([ax, ay], [bx, by]) = (a.at(), b.at());
            [ax + fraction * (bx - ax), ay + fraction * (by - ay)]
        };
        let mut sample = self.zero(curve, a, b, at);
        if border != 0 {
            for other in 0..CURVES {
                sample.values[other] =
                    with_common_sign(a.values[other], b.values[other], sample.values[other]);
            }
        }
        sample.values[curve] = 0.0;
        sample.border = border;
        sample
    }

    /// The point where two curves meet: a and b lie on `first`, and `curve` changes its sign between them.
    fn junction(&self, curve: usize, first: usize, a: &Sample, b: &Sample) -> Sample {
        let at = |fraction: f64| on_curve(self.triangle.domain, first, [a.at(), b.at()], fraction);
        let mut sample = self.zero(curve, a, b, at);
        // A crease of the common sheet ends where two limits of the strokes meet.
        for value in &mut sample.values[CREASES..] {
            if value.abs() <= SAME * self.triangle.domain.machine.mechanism.longest {
                *value = 0.0;
            }
        }
        sample.values[first] = 0.0;
        sample.values[curve] = 0.0;
        sample
    }

    /// The sample where `curve` vanishes on the way `at` from a to b.
    fn zero(&self, curve: usize, a: &Sample, b: &Sample, at: impl Fn(f64) -> [f64; 2]) -> Sample {
        let domain = self.triangle.domain;
        let value = |fraction| value(domain, curve, &domain.column(at(fraction)));
        Sample::new(domain, at(root::zero(a.values[curve], b.values[curve], RESOLUTION, value)))
    }

    /// A face with the points that divide its neighbours' sides.
    pub(super) fn with_divisions(&self, face: &[usize]) -> Face {
        let mut whole = Face::with_capacity(face.len());
        for (i, &a) in face.iter().enumerate() {
            whole.push(a);
            self.side_divisions(a, face[(i + 1) % face.len()], &mut whole);
        }
        whole
    }

    fn side_divisions(&self, a: usize, b: usize, whole: &mut Face) {
        let found = self.divided.iter().find(|(ends, _)| *ends == [a, b] || *ends == [b, a]);
        if let Some(&(_, between)) = found {
            self.side_divisions(a, between, whole);
            whole.push(between);
            self.side_divisions(between, b, whole);
        }
    }
}

/// A curve's value at a point of an edge, with the sign of the values at the edge's ends where they agree.
fn with_common_sign(a: f64, b: f64, value: f64) -> f64 {
    if a == 0.0 && b == 0.0 {
        0.0
    } else if a >= 0.0 && b >= 0.0 {
        value.max(f64::MIN_POSITIVE)
    } else if a <= 0.0 && b <= 0.0 {
        value.min(-f64::MIN_POSITIVE)
    } else {
        value
    }
}
