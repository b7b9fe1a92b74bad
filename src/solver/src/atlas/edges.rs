//! Points of a curve on the edges of boxes.

use super::chart::Chart;
use super::continuation::norm;
use super::enclosure::Enclosure;
use super::place::Configuration;
use super::search::{Cell, Found, LegSide, MOST, Search};
use crate::interval::Interval;
use crate::workspace::zero;

/// Halvings of an edge.
const DEEPEST: u32 = 24;
/// Newton steps.
const STEPS: usize = 20;

impl Search<'_> {
    /// Adds the points of the curve on an edge, on which the coordinate `axis` is constant. A point at the end of a
    /// part of the edge may be added twice.
    pub(super) fn edge(&self, edge: &Cell, axis: usize, depth: u32, found: &mut Found) {
        found.examined += 1;
        if found.examined > MOST {
            return;
        }
        let Some(enclosure) = Enclosure::of(self, edge) else { return };
        for leg in 0..2 {
            if edge.sides[leg] == LegSide::Either && enclosure.height_squares[leg].low > 0.0 {
                for side in [LegSide::Above, LegSide::Below] {
                    let mut part = *edge;
                    part.sides[leg] = side;
                    if side == LegSide::Above || !self.above_only[leg] {
                        self.edge(&part, axis, depth, found);
                    }
                }
                return;
            }
        }
        let is_deepest = depth >= DEEPEST;
        if enclosure.crosses_once(axis) || is_deepest {
            if !edge.sides.contains(&LegSide::Either) && !edge.sides.contains(&LegSide::Level) {
                found.points.extend(self.crossing(edge, axis));
                return;
            }
            let before = found.points.len();
            found.points.extend(
                self.newton_starts(edge).into_iter().filter_map(|start| self.newton(edge, axis, start)),
            );
            if found.points.len() > before || is_deepest {
                return;
            }
        }
        for part in edge.halved(1 - axis) {
            self.edge(&part, axis, depth + 1, found);
        }
    }

    /// The configuration at a point of an edge, without regard to the target.
    fn configuration(&self, [t, theta]: [f64; 2], signs: [f64; 2]) -> Configuration {
        let shape = self.system.shape;
        let [x1, second, third] = self.chart.configuration(shape, [t, theta]);
        let mut q = [x1, second, third, 0.0, 0.0];
        let squares = shape.place(&q).height_squares();
        for leg in 0..2 {
            q[3 + leg] = signs[leg] * squares[leg].max(0.0).sqrt();
        }
        q
    }

    fn value(&self, q: &Configuration) -> f64 {
        self.system.linearised(q).0[3]
    }

    /// The only zero of the target on an edge on which both legs have a side.
    fn crossing(&self, edge: &Cell, axis: usize) -> Option<Configuration> {
        let free = edge.ranges[1 - axis];
        let signs = edge.sides.map(LegSide::sign);
        let at = |fraction: f64| {
            let mut point = edge.ranges.map(|range| range.low);
            point[1 - axis] = free.low + fraction * (free.high - free.low);
            self.configuration(point, signs)
        };
        let [start, end] = [0.0, 1.0].map(|fraction| self.value(&at(fraction)));
        if start * end > 0.0 {
            return None;
        }
        Some(at(zero(start, end, 1e-16, |fraction| self.value(&at(fraction)))))
    }

    /// Where Newton's method begins on an edge on which a leg may be level.
    fn newton_starts(&self, edge: &Cell) -> Vec<Configuration> {
        let middle = edge.ranges.map(Interval::middle);
        let choices = |side: LegSide| match side {
            LegSide::Either => vec![0.7, -0.7],
            other => vec![other.sign()],
        };
        let mut starts = Vec::new();
        for second in choices(edge.sides[0]) {
            for third in choices(edge.sides[1]) {
                starts.push(self.configuration(middle, [second, third]));
            }
        }
        starts
    }

    /// Newton's method along an edge; `None` if it finds no point of it.
    fn newton(&self, edge: &Cell, axis: usize, start: Configuration) -> Option<Configuration> {
        let fixed = edge.ranges[axis].low;
        let normal = Chart::normal(axis, fixed);
        let mut q = start;
        for _ in 0..STEPS {
            let next = self.system.newton_step(&q, &start, &normal)?;
            let length = norm(&std::array::from_fn(|i| next[i] - q[i]));
            q = next;
            if length < 1e-12 {
                return self.is_on(edge, axis, &q).then_some(q);
            }
        }
        None
    }

    /// Whether a point of the curve is on an edge, with the sides of the edge.
    fn is_on(&self, edge: &Cell, axis: usize, q: &Configuration) -> bool {
        const SLACK: f64 = 1e-10;
        let free = edge.ranges[1 - axis];
        let [t, theta] = self.chart.coordinates(self.system.shape, q);
        let at = if axis == 0 { Chart::nearest(theta, free.middle()) } else { t };
        let side_fits = |leg: usize| match edge.sides[leg] {
            LegSide::Above => q[3 + leg] >= -SLACK,
            LegSide::Below => q[3 + leg] <= SLACK,
            LegSide::Either => !self.above_only[leg] || q[3 + leg] >= -SLACK,
            LegSide::Level => true,
        };
        (free.low - SLACK..=free.high + SLACK).contains(&at) && side_fits(0) && side_fits(1)
    }
}
