//! A line x = const: its structure and its integrals.

use std::convert::Infallible;

use super::line_intervals;
use crate::limit::Element;
use crate::workspace::column::Column;
use crate::workspace::cover::Cover;
use crate::workspace::domain::{ColumnEnd, Domain, Limit};
use crate::workspace::feasible_intervals::IntervalEnd;
use crate::workspace::quadrature::{Integral, adaptive};
use crate::workspace::root;

/// Halvings of an interval whose integrand is not smooth.
const DEPTH: u32 = 6;
/// Accuracy of a line's integral, as a fraction of the domain's area, or volume, per width.
const ACCURACY: f64 = 1e-9;

/// Extremes over all columns that the integration visits.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Extremes {
    pub(super) jacobian: Option<[f64; 2]>,
    /// Greatest |sin alpha|.
    pub(super) sine: Option<f64>,
}

impl Extremes {
    fn meet(&mut self, column: &Column, determinants: [f64; 2]) {
        for det in determinants {
            let [least, greatest] = self.jacobian.unwrap_or([det; 2]);
            self.jacobian = Some([least.min(det), greatest.max(det)]);
        }
        let sine = column.s.abs();
        self.sine = Some(self.sine.map_or(sine, |most| most.max(sine)));
    }
}

/// The structure of a line: for each interval the limits that end it (with the nearest rods if a limit is theirs),
/// and what bounds `z_lo` and `z_hi` along it. Between lines of equal structure the integrals are smooth in
/// x.
pub(super) type Structure = Vec<([Option<(usize, Element)>; 2], Vec<[ColumnEnd; 2]>)>;

/// A line and its feasible intervals.
pub(super) struct Line<'a> {
    domain: &'a Domain<'a>,
    x: f64,
    intervals: Vec<[IntervalEnd; 2]>,
}

impl<'a> Line<'a> {
    /// The line at x through a domain's cover.
    pub(super) fn new(domain: &'a Domain<'a>, cover: &Cover, x: f64) -> Self {
        Self { domain, x, intervals: line_intervals::intervals(domain, cover, x) }
    }

    pub(super) fn structure(&self) -> Structure {
        let mut found = Structure::new();
        for [low, high] in &self.intervals {
            let mut column_ends = vec![self.column_ends(&low.column)];
            self.creases(&low.column, &high.column, &mut |_, after| column_ends.push(after));
            found.push(([self.bound(low), self.bound(high)], column_ends));
        }
        found
    }

    fn bound(&self, end: &IntervalEnd) -> Option<(usize, Element)> {
        let limit = end.limit?;
        let binding = self.domain.binding_at(Limit::ALL[limit], [end.column.x, end.column.y]);
        Some((limit, binding.element))
    }

    /// The bounds that `z_lo` and `z_hi` follow.
    fn column_ends(&self, column: &Column) -> [ColumnEnd; 2] {
        [false, true].map(|upper| ColumnEnd::binding(self.domain.sheet(column, upper), upper))
    }

    /// Calls `at` with each y between two columns at which another bound begins, and the bounds beyond.
    fn creases(&self, a: &Column, b: &Column, at: &mut dyn FnMut(f64, [ColumnEnd; 2])) {
        let middle = self.domain.column([self.x, 0.5 * (a.y + b.y)]);
        for [from, to] in [[a, &middle], [&middle, b]] {
            self.creases_between(from, to, 3, at);
        }
    }

    fn creases_between(&self, a: &Column, b: &Column, depth: u32, at: &mut dyn FnMut(f64, [ColumnEnd; 2])) {
        let (before, after) = (self.column_ends(a), self.column_ends(b));
        if before == after {
            return;
        }
        let sheet = usize::from(before[0] == after[0]);
        let (i, j) = (before[sheet], after[sheet]);
        let lead = |column: &Column| {
            let heights = self.domain.sheet(column, sheet == 1);
            heights[i.index()] - heights[j.index()]
        };
        let at_fraction = |fraction: f64| a.y + fraction * (b.y - a.y);
        let fraction = root::zero(lead(a), lead(b), 1e-12, |fraction| {
            lead(&self.domain.column([self.x, at_fraction(fraction)]))
        });
        let y = at_fraction(fraction);
        // If the other sheet changes as well, or a third bound, each side has its own bounds.
        let crease = self.domain.column([self.x, y]);
        let there = self.column_ends(&crease);
        let other = 1 - sheet;
        let single = before[other] == after[other] && (there[sheet] == i || there[sheet] == j);
        if single || depth == 0 || y <= a.y || y >= b.y {
            at(y, after);
        } else {
            let step = 1e-9 * (b.y - a.y);
            let (left, right) =
                (self.domain.column([self.x, y - step]), self.domain.column([self.x, y + step]));
            self.creases_between(a, &left, depth - 1, at);
            if self.column_ends(&left) != self.column_ends(&right) {
                at(y, self.column_ends(&right));
            }
            self.creases_between(&right, b, depth - 1, at);
        }
    }

    /// Length of the line's intervals, and the integral of their columns' volume.
    pub(super) fn integrals(&self, allowed: &[f64; 2], extremes: &mut Extremes) -> Integral<2> {
        let mut total = Integral::ZERO;
        for [low, high] in &self.intervals {
            let mut from = low.t;
            let mut cuts = Vec::new();
            self.creases(&low.column, &high.column, &mut |y, _| cuts.push(y));
            for end in [low, high] {
                self.integrand(&end.column, extremes);
            }
            cuts.push(high.t);
            for to in cuts {
                if to > from {
                    total.add(&self.integral([from, to], &allowed.map(|a| a * ACCURACY), extremes));
                }
                from = from.max(to);
            }
        }
        total
    }

    fn integral(&self, range: [f64; 2], allowed: &[f64; 2], extremes: &mut Extremes) -> Integral<2> {
        let Ok(integral) = adaptive::<2, Infallible>(range, allowed, DEPTH, &mut |y, _, _| {
            let column = self.domain.column([self.x, y]);
            Ok(Integral { value: [1.0, self.integrand(&column, extremes)], error: [0.0; 2] })
        });
        integral
    }

    /// ∫ of the Jacobian determinant along a column.
    fn integrand(&self, column: &Column, extremes: &mut Extremes) -> f64 {
        let [low, high] = self.domain.ends(column);
        let [_, ay] = column.angle_rates(self.domain.machine);
        let [j0, j1] = self.domain.image.determinant(column, ay);
        extremes.meet(column, [j0 + j1 * low, j0 + j1 * high]);
        (high - low) * (j0 + j1 * 0.5 * (low + high))
    }
}
