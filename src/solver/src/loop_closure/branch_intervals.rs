//! The arc around a near double root, and the intervals of it on which both branches exist.

use std::f64::consts::{FRAC_PI_2, PI};

use arrayvec::ArrayVec;

use super::equations::{LoopClosure, Root};
use crate::fast_math::sin_cos;

/// Number of even steps of the arc in which the branches are examined.
const EVEN: u8 = 16;
/// Further distances from the near double root at which they are examined.
const CLOSE: [f64; 6] = [1e-2, 3e-3, 1e-3, 1e-4, 1e-5, 1e-6];
/// Ratio of the steps in which branches are examined where they meet or nearly meet.
const RATIO: f64 = 0.1;
/// Number of these steps.
const STEPS: i32 = 10;
/// Fraction of its greatest value below which the discriminant is small: the branches nearly meet.
const SMALL: f64 = 1e-2;
/// Steps of a golden-section search and of a bisection.
const GOLDEN_STEPS: u8 = 80;
const BISECTIONS: u8 = 64;

/// Offsets in rising order.
pub(super) type Offsets = ArrayVec<f64, 96>;

/// An arc, in offsets from 0 or π: there the angle's sine has all its digits however small it is.
#[derive(Clone, Copy, Debug)]
pub(super) struct OffsetArc {
    base: f64,
    /// The base's cosine.
    side: f64,
    ends: [f64; 2],
    /// The near double root.
    at: f64,
}

/// An interval on which the branches exist.
#[derive(Clone, Debug)]
pub(super) struct BranchInterval {
    /// Offsets of the samples, including the ends.
    pub(super) offsets: Offsets,
    /// Whether the branches meet at the lower and the upper end.
    pub(super) meets: [bool; 2],
}

impl OffsetArc {
    pub(super) fn new([low, high]: [f64; 2], at: f64) -> Self {
        let base = if at.abs() < FRAC_PI_2 { 0.0 } else { PI.copysign(at) };
        let side = if base == 0.0 { 1.0 } else { -1.0 };
        Self { base, side, ends: [low - base, high - base], at: at - base }
    }

    /// Cosine and sine at an offset.
    pub(super) fn direction(&self, offset: f64) -> [f64; 2] {
        let (s, c) = sin_cos(offset);
        [self.side * c, self.side * s]
    }

    /// A root at an offset.
    pub(super) fn root(&self, offset: f64, w: f64, merged: bool) -> Root {
        Root { merged, ..Root::at(self.base + offset, self.direction(offset), w) }
    }

    /// The intervals on which the branches exist.
    pub(super) fn branch_intervals<const M: usize, C: LoopClosure<M>>(
        &self,
        closure: &C,
    ) -> ArrayVec<BranchInterval, 6> {
        let discriminant = |offset: f64| {
            let [c, s] = self.direction(offset);
            closure.discriminant(c, s)
        };
        let offsets = self.with_extrema(&discriminant);
        let mut intervals = ArrayVec::<BranchInterval, 6>::new();
        let mut open: Option<BranchInterval> =
            (discriminant(offsets[0]) >= 0.0).then(|| BranchInterval::from(offsets[0], false));
        for pair in offsets.windows(2) {
            let [from, to] = [pair[0], pair[1]];
            match (discriminant(from) >= 0.0, discriminant(to) >= 0.0) {
                (false, true) => {
                    open = Some(BranchInterval::from(end_of_branches(&discriminant, from, to), true));
                }
                (true, false) => {
                    let last = open
                        .take()
                        .map(|interval| interval.to(end_of_branches(&discriminant, to, from), true));
                    intervals.extend(last.into_iter().take(intervals.remaining_capacity()));
                }
                _ => {}
            }
            if let Some(interval) = &mut open
                && discriminant(to) >= 0.0
            {
                interval.push(to);
            }
        }
        let last = open.map(|interval| interval.to(self.ends[1], false));
        intervals.extend(last.into_iter().take(intervals.remaining_capacity()));
        for interval in &mut intervals {
            interval.refine(&discriminant);
        }
        intervals
    }

    /// Offsets to begin with, and the extrema of the discriminant between them.
    fn with_extrema(&self, discriminant: &impl Fn(f64) -> f64) -> Offsets {
        let [low, high] = self.ends;
        let even = (0..=EVEN).map(|i| low + (high - low) * f64::from(i) / f64::from(EVEN));
        let close = CLOSE.into_iter().flat_map(|apart| [self.at - apart, self.at + apart]);
        let inside = |offset: &f64| (low..=high).contains(offset);
        let mut offsets: Offsets = even.chain(close).filter(inside).collect();
        offsets.sort_unstable_by(f64::total_cmp);
        let mut extrema = ArrayVec::<f64, 8>::new();
        for near in offsets.windows(3) {
            let [a, b, c] = [near[0], near[1], near[2]].map(discriminant);
            // A peak that may reach above zero, or a valley that may reach below.
            let up = if b >= a && b >= c && b < 0.0 { 1.0 } else { -1.0 };
            if up > 0.0 || (b <= a && b <= c && b >= 0.0 && b < SMALL * a.max(c)) {
                let peak = peak(&|offset| up * discriminant(offset), near[0], near[2]);
                extrema.extend(Some(peak).into_iter().take(extrema.remaining_capacity()));
            }
        }
        offsets.extend(extrema);
        offsets.sort_unstable_by(f64::total_cmp);
        offsets
    }
}

impl BranchInterval {
    fn from(offset: f64, meet: bool) -> Self {
        Self { offsets: [offset].into_iter().collect(), meets: [meet, false] }
    }

    fn to(mut self, offset: f64, meet: bool) -> Self {
        self.push(offset);
        Self { meets: [self.meets[0], meet], ..self }
    }

    fn push(&mut self, offset: f64) {
        let rises = self.offsets.last().is_none_or(|last| *last < offset);
        if rises && !self.offsets.is_full() {
            self.offsets.push(offset);
        }
    }

    /// Adds offsets towards ends where the branches meet, and towards a valley in which they nearly meet: there the
    /// branches bend within that distance.
    fn refine(&mut self, discriminant: &impl Fn(f64) -> f64) {
        let (low, high) = (self.offsets[0], self.offsets[self.offsets.len() - 1]);
        let reach = high - low;
        let steps = (1..=STEPS).map(|step| reach * RATIO.powi(step));
        let mut more = ArrayVec::<f64, 48>::new();
        if self.meets[0] {
            more.extend(steps.clone().map(|step| low + step));
        }
        if self.meets[1] {
            more.extend(steps.clone().map(|step| high - step));
        }
        let lowest =
            self.offsets.iter().copied().min_by(|a, b| discriminant(*a).total_cmp(&discriminant(*b)));
        let top = self.offsets.iter().map(|offset| discriminant(*offset)).fold(0.0, f64::max);
        if let Some(lowest) = lowest.filter(|lowest| *lowest > low && *lowest < high)
            && discriminant(lowest) < SMALL * top
        {
            more.extend(steps.flat_map(|step| [lowest - step, lowest + step]));
        }
        let free = self.offsets.remaining_capacity();
        self.offsets.extend(more.into_iter().filter(|offset| (low..=high).contains(offset)).take(free));
        self.offsets.sort_unstable_by(f64::total_cmp);
    }
}

/// Finds where a function that is negative at `outside` and not at `inside` becomes zero: the last offset at which it
/// is not negative.
fn end_of_branches(discriminant: &impl Fn(f64) -> f64, mut outside: f64, mut inside: f64) -> f64 {
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (outside + inside);
        if discriminant(middle) >= 0.0 { inside = middle } else { outside = middle }
    }
    inside
}

/// The offset of the greatest value, by golden section.
fn peak(discriminant: &impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    for _ in 0..GOLDEN_STEPS {
        let part = GOLDEN * (high - low);
        if discriminant(high - part) > discriminant(low + part) {
            high = low + part;
        } else {
            low = high - part;
        }
    }
    0.5 * (low + high)
}
