//! A posture over a box: bounds of the quantities on which the limits depend.
//!
//! Leg I determines alpha, see [`LegOneBounds`]. Everything else follows from sums, products and roots of functions
//! over the box.

use super::leg_one::{FLAT, LegOneBounds};
use super::rectangle::Rectangle;
use crate::interval::Interval;
use crate::jet::Jet;
use crate::rods::Rods;
use crate::workspace::column::Column;
use crate::workspace::domain::Domain;
use crate::workspace::image::Image;

/// The ranges of a posture's quantities over a box that does not straddle y = 0, where leg I is in the working mode.
pub(super) struct PostureBounds<'a> {
    pub(super) domain: &'a Domain<'a>,
    /// The box relative to the point at which the limits are also evaluated.
    pub(super) offsets: [Interval; 2],
    /// The sign of y.
    pub(super) side: f64,
    /// Whether leg I is in the working mode all over the box.
    pub(super) leg_one_works: bool,
    /// x + e1 and x + e2, and y.
    pub(super) x: [Jet; 2],
    pub(super) y: Jet,
    pub(super) alpha: Jet,
    pub(super) c: Jet,
    pub(super) s: Jet,
    /// The drops' squares of legs II and III, and the drops.
    pub(super) squares: [Jet; 2],
    drops: [Jet; 3],
    pub(super) vectors: [[Jet; 3]; 4],
    /// The column at the box's middle, or at its corner nearest to X1 = y = 0. On the way from there to any point
    /// where leg I is in the working mode, it stays in it.
    pub(super) column: Column,
    pub(super) rods: Rods,
}

impl<'a> PostureBounds<'a> {
    /// The ranges over a box; `None` if leg I is nowhere in the working mode there.
    pub(super) fn over(domain: &'a Domain<'a>, [low, high]: Rectangle) -> Option<Self> {
        let (g, d) = (domain.machine.geometry(), &domain.machine.mechanism);
        let leg_one = LegOneBounds::over(domain, [low, high])?;
        let side = if low[1] >= 0.0 { 1.0 } else { -1.0 };
        let signed = |size: Interval| size.times(-side);
        let (s, c) = (signed(leg_one.s), leg_one.c);
        let box_x = Interval::new(low[0], high[0]);
        let x = [d.e1, d.e2].map(|offset| Jet::coordinate(box_x.plus(offset), 0));
        let y = Jet::coordinate(Interval::new(low[1], high[1]), 1);
        let [ax, ay] = leg_one.angle_rates(domain, s, x[0].value);
        let alpha = Jet { value: signed(leg_one.angle), slopes: [ax, ay] };
        let cosine = Jet { value: c, slopes: [-(s * ax), -(s * ay)] };
        let sine = Jet { value: s, slopes: [c * ax, c * ay] };
        let bend = s.times(0.5 * d.k);
        let inverse = -leg_one.w.reciprocal();
        let slopes = [(x[0].value + bend * ax) * inverse, (y.value + bend * ay) * inverse];
        let w1 = Jet { value: leg_one.w, slopes };
        let at = if leg_one.works_everywhere {
            [0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])]
        } else {
            [(-d.e1).clamp(low[0], high[0]), 0.0_f64.clamp(low[1], high[1])]
        };
        let offsets = [0, 1].map(|axis| Interval::new(low[axis] - at[axis], high[axis] - at[axis]));
        let mut column = domain.column(at);
        let (u, v) = (cosine.times(g.R1).plus(-g.r1), sine.times(g.R1));
        let p = cosine.times(g.R2).plus(-g.r4);
        let reaches = [y - p, y + p];
        let margin = domain.machine.limits().serial_margin;
        let squares = [0, 1].map(|leg| {
            let length = [g.L2, g.L3][leg];
            let square = (-(x[1].square() + reaches[leg].square())).plus(length * length);
            square.centred_at(column.square[leg + 1], offsets)
        });
        // A leg that does not reach its least drop is treated as having it.
        let least = [g.L2, g.L3].map(|length| margin.max(FLAT) * length);
        let [w2, w3] = [0, 1].map(|leg| squares[leg].root(least[leg] * least[leg]));
        let q = g.R2 * column.s;
        column.w = [column.w[0], column.w[1].max(least[0]), column.w[2].max(least[1])];
        column.f = [column.w[0], q + column.w[1], column.w[2] - q];
        let vectors =
            [[x[0], y + u, w1 + v], [x[0], y - u, w1 - v], [x[1], reaches[0], w2], [x[1], reaches[1], w3]];
        let rods = domain.rods(&column);
        Some(Self {
            domain,
            offsets,
            side,
            leg_one_works: leg_one.works_everywhere,
            x,
            y,
            alpha,
            c: cosine,
            s: sine,
            squares,
            drops: [w1, w2, w3],
            vectors,
            column,
            rods,
        })
    }

    /// z - rho of each slider.
    pub(super) fn slider_drops(&self) -> [Jet; 3] {
        let q = self.s.times(self.domain.machine.geometry().R2);
        let [w1, w2, w3] = self.drops;
        [w1, q + w2, w3 - q]
    }

    /// A bound of a column's volume over its area: its greatest height times the greatest Jacobian
    /// determinant.
    pub(super) fn weight(&self) -> f64 {
        let stroke = &self.domain.machine.limits().stroke;
        let height = stroke.iter().map(|[low, high]| high - low).fold(f64::INFINITY, f64::min);
        let turn = self.alpha.slopes[1];
        let det = match self.domain.image {
            Image::Platform => 1.0,
            Image::Tool { length } => (self.c.value * turn).times(-length).plus(1.0).magnitude(),
            Image::Part { table, .. } => {
                let w = self.drops[0].value;
                let z = Interval::new(stroke[0][0] + w.low, stroke[0][1] + w.high);
                (turn * z.plus(-table.da)).plus(1.0).magnitude()
            }
        };
        height * det
    }

    /// The sign of x + e1, if it has one.
    pub(super) fn beside(&self) -> i8 {
        self.x[0].value.sign()
    }
}
