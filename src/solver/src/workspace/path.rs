//! The feasible intervals of a path through the plane.

use super::column::Column;
use super::domain::{Domain, LIMITS, Values};
use super::root;

/// Resolution of an interval's end, as a part of the segment it is found on.
const RESOLUTION: f64 = 1e-13;
/// Halvings of a segment on which a limit may vanish twice.
const DEPTH: u32 = 10;
/// How much of the deviation from a straight line is added to be safe against what a parabola
/// through three points does not show.
const CAUTION: f64 = 1.5;

/// A point of the path.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stop {
    pub(super) t: f64,
    pub(super) column: Column,
    values: Values,
}

/// An end of an interval and the limit that ends it; `None` at the path's own end.
#[derive(Clone, Copy, Debug)]
pub(super) struct End {
    pub(super) t: f64,
    pub(super) column: Column,
    pub(super) limit: Option<usize>,
}

/// A path through the plane and the domain it crosses.
pub(super) struct Path<'a, F> {
    pub(super) domain: &'a Domain<'a>,
    pub(super) at: F,
}

impl<F: Fn(f64) -> [f64; 2]> Path<'_, F> {
    /// The intervals of `[from, to]` on which every limit holds, found from `pieces` segments.
    pub(super) fn intervals(&self, [from, to]: [f64; 2], pieces: u32) -> Vec<[End; 2]> {
        let mut found = Vec::new();
        let step = (to - from) / f64::from(pieces);
        let mut start = self.stop(from);
        for piece in 1..=pieces {
            let end = self.stop(if piece == pieces { to } else { from + step * f64::from(piece) });
            self.segment(&start, &end, DEPTH, &mut found);
            start = end;
        }
        found
    }

    fn stop(&self, t: f64) -> Stop {
        let column = self.domain.column((self.at)(t));
        Stop { t, column, values: self.domain.values(&column) }
    }

    fn segment(&self, a: &Stop, b: &Stop, depth: u32, found: &mut Vec<[End; 2]>) {
        let middle = self.stop(0.5 * (a.t + b.t));
        let mut simple = true;
        for limit in 0..LIMITS {
            match shape(a.values[limit], middle.values[limit], b.values[limit]) {
                Shape::Outside => return,
                Shape::Simple => {}
                Shape::Doubtful => simple = false,
            }
        }
        if simple || depth == 0 {
            self.clip(a, b, found);
        } else {
            self.segment(a, &middle, depth - 1, found);
            self.segment(&middle, b, depth - 1, found);
        }
    }

    /// Every limit vanishes at most once between a and b.
    fn clip(&self, a: &Stop, b: &Stop, found: &mut Vec<[End; 2]>) {
        let (mut low, mut high) = (*a, *b);
        let (mut ends, mut inside) = ([None, None], true);
        for limit in 0..LIMITS {
            match (low.values[limit] >= 0.0, high.values[limit] >= 0.0) {
                (true, true) => {}
                (false, false) => inside = false,
                (true, false) => (high, ends[1]) = (self.zero(limit, &low, &high), Some(limit)),
                (false, true) => (low, ends[0]) = (self.zero(limit, &low, &high), Some(limit)),
            }
            if !inside {
                return;
            }
        }
        let end = |stop: &Stop, limit| End { t: stop.t, column: stop.column, limit };
        match found.last_mut() {
            Some(last) if ends[0].is_none() && last[1].limit.is_none() && last[1].t == low.t => {
                last[1] = end(&high, ends[1]);
            }
            _ => found.push([end(&low, ends[0]), end(&high, ends[1])]),
        }
    }

    fn zero(&self, limit: usize, a: &Stop, b: &Stop) -> Stop {
        let between = |part: f64| a.t + part * (b.t - a.t);
        let part = root::zero(a.values[limit], b.values[limit], RESOLUTION, |part| {
            self.domain.value(limit, &self.domain.column((self.at)(between(part))))
        });
        let mut stop = self.stop(between(part));
        stop.values[limit] = 0.0;
        stop
    }
}

/// What a limit does between two points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shape {
    /// Negative throughout.
    Outside,
    /// Not negative throughout, or of different signs at the ends.
    Simple,
    /// Of one sign at the ends, and perhaps not between.
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
