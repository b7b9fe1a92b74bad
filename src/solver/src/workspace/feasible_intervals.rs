//! The feasible intervals of a curve: the parameters at which every limit is kept.

use super::column::Column;
use super::domain::{Domain, LIMITS, Values};
use super::root;

/// Resolution of an interval's end, as a fraction of its segment.
const RESOLUTION: f64 = 1e-13;
/// Halvings of a segment on which a limit may vanish twice.
const DEPTH: u32 = 10;
/// Fraction of the deviation from a straight line that is added to allow for what a parabola through three points
/// does not show.
const CAUTION: f64 = 1.5;

/// Functions of one parameter. Each is positive where its limit is kept.
pub(super) trait LimitFunctions<const N: usize> {
    /// The values of all functions.
    fn values(&self, t: f64) -> [f64; N];
    /// The value of one function.
    fn value(&self, limit: usize, t: f64) -> f64;
}

/// An end of an interval and the limit that ends it; `None` at the range's own end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cut {
    pub(super) t: f64,
    pub(super) limit: Option<usize>,
}

/// Finds the intervals of a range on which every limit is kept, on `segments` segments.
///
/// On a segment each limit is approximated by the parabola through its ends and its middle, with half as much
/// curvature again. If that may vanish twice, the segment is halved. A limit that turns twice between two samples,
/// half a segment apart, is not detected.
pub(super) fn intervals<const N: usize>(
    limits: &impl LimitFunctions<N>,
    [from, to]: [f64; 2],
    segments: u32,
) -> Vec<[Cut; 2]> {
    let mut found = Vec::new();
    let step = (to - from) / f64::from(segments);
    let mut start = Sample::at(limits, from);
    for number in 1..=segments {
        let end = Sample::at(limits, if number == segments { to } else { from + step * f64::from(number) });
        on_segment(limits, &start, &end, DEPTH, &mut found);
        start = end;
    }
    found
}

/// A parameter and the values there.
#[derive(Clone, Copy, Debug)]
struct Sample<const N: usize> {
    t: f64,
    values: [f64; N],
}

impl<const N: usize> Sample<N> {
    fn at(limits: &impl LimitFunctions<N>, t: f64) -> Self {
        Self { t, values: limits.values(t) }
    }
}

fn on_segment<const N: usize>(
    limits: &impl LimitFunctions<N>,
    a: &Sample<N>,
    b: &Sample<N>,
    depth: u32,
    found: &mut Vec<[Cut; 2]>,
) {
    let middle = Sample::at(limits, 0.5 * (a.t + b.t));
    let mut simple = true;
    for limit in 0..N {
        match shape(a.values[limit], middle.values[limit], b.values[limit]) {
            Shape::Outside => return,
            Shape::Simple => {}
            Shape::Doubtful => simple = false,
        }
    }
    if simple || depth == 0 {
        clip(limits, a, b, found);
    } else {
        on_segment(limits, a, &middle, depth - 1, found);
        on_segment(limits, &middle, b, depth - 1, found);
    }
}

/// Finds the interval between a and b, where every limit vanishes at most once.
fn clip<const N: usize>(
    limits: &impl LimitFunctions<N>,
    a: &Sample<N>,
    b: &Sample<N>,
    found: &mut Vec<[Cut; 2]>,
) {
    let (mut low, mut high) = (*a, *b);
    let mut ends = [None, None];
    for limit in 0..N {
        match (low.values[limit] >= 0.0, high.values[limit] >= 0.0) {
            (true, true) => {}
            (false, false) => return,
            (true, false) => (high, ends[1]) = (zero(limits, limit, &low, &high), Some(limit)),
            (false, true) => (low, ends[0]) = (zero(limits, limit, &low, &high), Some(limit)),
        }
    }
    let end = |sample: &Sample<N>, limit| Cut { t: sample.t, limit };
    match found.last_mut() {
        Some(last) if ends[0].is_none() && last[1].limit.is_none() && last[1].t == low.t => {
            last[1] = end(&high, ends[1]);
        }
        _ => found.push([end(&low, ends[0]), end(&high, ends[1])]),
    }
}

fn zero<const N: usize>(
    limits: &impl LimitFunctions<N>,
    limit: usize,
    a: &Sample<N>,
    b: &Sample<N>,
) -> Sample<N> {
    let between = |fraction: f64| a.t + fraction * (b.t - a.t);
    let value = |fraction| limits.value(limit, between(fraction));
    let fraction = root::zero(a.values[limit], b.values[limit], RESOLUTION, value);
    let mut sample = Sample::at(limits, between(fraction));
    sample.values[limit] = 0.0;
    sample
}

/// An end of an interval, its column and the number of the limit that ends it; `None` at the curve's own end.
#[derive(Clone, Copy, Debug)]
pub(super) struct IntervalEnd {
    pub(super) t: f64,
    pub(super) column: Column,
    pub(super) limit: Option<usize>,
}

/// A curve through the plane and the domain it crosses.
pub(super) struct Curve<'a, F> {
    pub(super) domain: &'a Domain<'a>,
    pub(super) at: F,
}

impl<F: Fn(f64) -> [f64; 2]> Curve<'_, F> {
    /// The intervals of `[from, to]` on which every limit is kept, found from `segments` segments.
    pub(super) fn intervals(&self, range: [f64; 2], segments: u32) -> Vec<[IntervalEnd; 2]> {
        let end = |Cut { t, limit }| IntervalEnd { t, column: self.domain.column((self.at)(t)), limit };
        intervals(self, range, segments).into_iter().map(|cuts| cuts.map(end)).collect()
    }
}

impl<F: Fn(f64) -> [f64; 2]> LimitFunctions<LIMITS> for Curve<'_, F> {
    fn values(&self, t: f64) -> Values {
        self.domain.values(&self.domain.column((self.at)(t)))
    }

    fn value(&self, limit: usize, t: f64) -> f64 {
        self.domain.value(limit, &self.domain.column((self.at)(t)))
    }
}

/// The behaviour of a limit between two points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shape {
    /// Negative throughout.
    Outside,
    /// Not negative throughout, or of different signs at the ends.
    Simple,
    /// The same sign at both ends, and possibly another between.
    Doubtful,
}

/// The shape of a function from its values at two points and half-way between: the control
/// polygon of the parabola through them decides.
#[inline]
pub(super) fn shape(start: f64, middle: f64, end: f64) -> Shape {
    let control = control([start, middle, end]);
    match (start >= 0.0, end >= 0.0) {
        (true, true) if control >= 0.0 && middle >= 0.0 => Shape::Simple,
        (false, false) if control < 0.0 && middle < 0.0 => Shape::Outside,
        (true, false) | (false, true) => Shape::Simple,
        _ => Shape::Doubtful,
    }
}

/// The middle control value of the parabola through three values, moved to be on the safe side.
#[inline]
pub(super) fn control([start, middle, end]: [f64; 3]) -> f64 {
    middle + CAUTION * (middle - 0.5 * (start + end))
}
