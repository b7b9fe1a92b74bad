//! A line x = const: its structure and its integrals.

use std::convert::Infallible;

use super::super::column::Column;
use super::super::cover::Cover;
use super::super::domain::Domain;
use super::super::path::End;
use super::super::quadrature::{Integral, rule};
use super::super::root;
use super::crossing;
use crate::limit::Element;

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
/// and the sliders that bind `z_lo` and `z_hi` along it. Between lines of equal structure the integrals are smooth in
/// x.
pub(super) type Structure = Vec<([Option<(usize, Element)>; 2], Vec<[usize; 2]>)>;

/// A line and its feasible intervals, cut where another slider binds.
pub(super) struct Line<'a> {
    domain: &'a Domain<'a>,
    x: f64,
    intervals: Vec<[End; 2]>,
}

impl<'a> Line<'a> {
    /// The line at x through a domain's cover.
    pub(super) fn new(domain: &'a Domain<'a>, cover: &Cover, x: f64) -> Self {
        Self { domain, x, intervals: crossing::intervals(domain, cover, x) }
    }

    pub(super) fn structure(&self) -> Structure {
        let mut found = Structure::new();
        for [low, high] in &self.intervals {
            let mut sliders = vec![self.sliders(&low.column)];
            self.creases(&low.column, &high.column, &mut |_, after| sliders.push(after));
            found.push(([self.bound(low), self.bound(high)], sliders));
        }
        found
    }

    fn bound(&self, end: &End) -> Option<(usize, Element)> {
        let limit = end.limit?;
        let number = u8::try_from(limit).unwrap_or(u8::MAX);
        Some((limit, self.domain.binding_at(number, [end.column.x, end.column.y]).element))
    }

    /// The sliders that bind `z_lo` and `z_hi`.
    fn sliders(&self, column: &Column) -> [usize; 2] {
        [false, true].map(|upper| Domain::binding_slider(self.domain.sheet(column, upper), upper))
    }

    /// Calls `at` with each y between two columns at which another slider begins to bind, and the
    /// sliders that bind beyond.
    fn creases(&self, a: &Column, b: &Column, at: &mut dyn FnMut(f64, [usize; 2])) {
        let middle = self.domain.column([self.x, 0.5 * (a.y + b.y)]);
        for [from, to] in [[a, &middle], [&middle, b]] {
            self.creases_between(from, to, 3, at);
        }
    }

    fn creases_between(&self, a: &Column, b: &Column, depth: u32, at: &mut dyn FnMut(f64, [usize; 2])) {
        let (before, after) = (self.sliders(a), self.sliders(b));
        if before == after {
            return;
        }
        let sheet = usize::from(before[0] == after[0]);
        let (i, j) = (before[sheet], after[sheet]);
        let lead = |column: &Column| {
            let heights = self.domain.sheet(column, sheet == 1);
            heights[i] - heights[j]
        };
        let part = root::zero(lead(a), lead(b), 1e-12, |part| {
            lead(&self.domain.column([self.x, a.y + part * (b.y - a.y)]))
        });
        let y = a.y + part * (b.y - a.y);
        // If the other sheet, or the third slider, changes as well, each side has its own sliders.
        let crease = self.domain.column([self.x, y]);
        let there = self.sliders(&crease);
        let other = 1 - sheet;
        let single = before[other] == after[other] && (there[sheet] == i || there[sheet] == j);
        if single || depth == 0 || y <= a.y || y >= b.y {
            at(y, after);
        } else {
            let step = 1e-9 * (b.y - a.y);
            let (left, right) =
                (self.domain.column([self.x, y - step]), self.domain.column([self.x, y + step]));
            self.creases_between(a, &left, depth - 1, at);
            if self.sliders(&left) != self.sliders(&right) {
                at(y, self.sliders(&right));
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
                    let share = allowed.map(|a| a * ACCURACY);
                    total.add(&self.integral([from, to], &share, DEPTH, extremes));
                }
                from = from.max(to);
            }
        }
        total
    }

    fn integral(&self, range: [f64; 2], allowed: &[f64; 2], depth: u32, seen: &mut Extremes) -> Integral<2> {
        let Ok(whole) = rule::<2, Infallible>(range, |y| {
            let column = self.domain.column([self.x, y]);
            let value = [1.0, self.integrand(&column, seen)];
            Ok(Integral { value, error: [0.0; 2] })
        });
        if depth == 0 || whole.within(allowed) {
            return whole;
        }
        let middle = 0.5 * (range[0] + range[1]);
        let allowed = allowed.map(|a| 0.5 * a);
        let mut total = self.integral([range[0], middle], &allowed, depth - 1, seen);
        total.add(&self.integral([middle, range[1]], &allowed, depth - 1, seen));
        total
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
