//! Every limit over a box: bounds of its values and of its gradient.
//!
//! Leg I determines alpha, see [`First`]. Everything else follows from sums, products and roots of functions over the
//! box.

use std::ops::Neg;

use super::super::column::Column;
use super::super::domain::{Domain, INTERFERENCE, PAIRS, STROKES, TABLE, TILT};
use super::super::image::Image;
use super::first::{FLAT, First};
use super::interval::{Interval, Jet};
use super::separation::separation;
use crate::parallel_matrix::determinant;
use crate::rods::Rods;

/// First of the limits of rods other than leg I's two.
const OTHER_RODS: usize = INTERFERENCE + 1;

/// The ranges of all quantities over a box that does not straddle y = 0, where leg I is in the working mode.
pub(super) struct Ranges<'a> {
    pub(super) domain: &'a Domain<'a>,
    /// The box relative to the point at which the limits are also evaluated.
    pub(super) offsets: [Interval; 2],
    /// The sign of y.
    pub(super) side: f64,
    /// Whether leg I is in the working mode all over the box.
    pub(super) first: bool,
    /// x + e1 and x + e2, and y.
    x: [Jet; 2],
    y: Jet,
    alpha: Jet,
    pub(super) c: Jet,
    pub(super) s: Jet,
    /// The drops' squares of legs II and III, and the drops.
    squares: [Jet; 2],
    drops: [Jet; 3],
    pub(super) vectors: [[Jet; 3]; 4],
    /// The column at the box's middle, or at its corner nearest to X1 = y = 0. On the way from there to any point
    /// where leg I is in the working mode, it stays in it.
    column: Column,
    pub(super) rods: Rods,
}

impl<'a> Ranges<'a> {
    /// The ranges over a box; `None` if leg I is nowhere in the working mode there.
    pub(super) fn over(domain: &'a Domain<'a>, [low, high]: [[f64; 2]; 2]) -> Option<Self> {
        let (g, d) = (domain.machine.geometry(), &domain.machine.mechanism);
        let first = First::over(domain, [low, high])?;
        let side = if low[1] >= 0.0 { 1.0 } else { -1.0 };
        let signed = |size: Interval| size.times(-side);
        let (s, c) = (signed(first.s), first.c);
        let box_x = Interval::new(low[0], high[0]);
        let x = [d.e1, d.e2].map(|offset| Jet::coordinate(box_x.plus(offset), 0));
        let y = Jet::coordinate(Interval::new(low[1], high[1]), 1);
        let [ax, ay] = first.angle_rates(domain, s, x[0].value);
        let alpha = Jet { value: signed(first.angle), slopes: [ax, ay] };
        let cosine = Jet { value: c, slopes: [-(s * ax), -(s * ay)] };
        let sine = Jet { value: s, slopes: [c * ax, c * ay] };
        let bend = s.times(0.5 * d.k);
        let inverse = -first.w.reciprocal();
        let slopes = [(x[0].value + bend * ax) * inverse, (y.value + bend * ay) * inverse];
        let w1 = Jet { value: first.w, slopes };
        let at = if first.whole {
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
            first: first.whole,
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

    /// The bounds of one limit, or, for the limits of leg I's rods, of a function of the same sign; and whether it
    /// may have a kink where it vanishes.
    pub(super) fn limit(&self, limit: usize) -> (Jet, bool) {
        match limit {
            INTERFERENCE => (self.leg_one_apart(), false),
            // The distance of a parallelogram's own rods depends on x alone. The cover excludes the x where it is too
            // small.
            OTHER_RODS..STROKES => separation(self, 2.0 * self.domain.machine.geometry().rod_radius),
            TABLE => self.above_table(),
            _ => {
                let value = self.domain.with_rods(limit, &self.column, &self.rods);
                (self.plainly(limit).centred_at(value, self.offsets), false)
            }
        }
    }

    fn plainly(&self, limit: usize) -> Jet {
        let (g, limits) = (self.domain.machine.geometry(), self.domain.machine.limits());
        match limit {
            // In the working mode leg I reaches.
            0 => self.c,
            1 => self.c.times(g.R1).plus(-g.r1),
            2 | 3 => self.vectors[limit - 2][2].plus(-limits.serial_margin * g.L1),
            4 => self.squares[0].plus(-(limits.serial_margin * g.L2).powi(2)),
            5 => self.squares[1].plus(-(limits.serial_margin * g.L3).powi(2)),
            6 => self.determinant(),
            7..=10 => self.cone(limit - 7, false),
            11..INTERFERENCE => self.cone(limit - 11, true),
            STROKES..TILT => self.stroke(limit - STROKES),
            _ => self.tilt(limit - TILT).0,
        }
    }

    /// Leg I's rods begin at one slider, 2 r1 apart along y, and with R1 cos a > r1 they diverge: the
    /// nearest points are a slider end and its foot on the other rod, or that rod's end. Their
    /// distance falls with |y| - u, from 2 r1.
    fn leg_one_apart(&self) -> Jet {
        let g = self.domain.machine.geometry();
        let (r1, radius) = (g.r1, g.rod_radius);
        let foot = g.L1 * (1.0 - (radius / r1).powi(2)).max(0.0).sqrt();
        let end = r1 + (0.25 * g.L1 * g.L1 - radius * radius) / r1;
        let most = if 2.0 * r1 * foot <= g.L1 * g.L1 { foot } else { end };
        let most = if radius > r1 { f64::NEG_INFINITY } else { most };
        let u = self.c.times(g.R1).plus(-g.r1);
        let size = self.y.times(self.side);
        let value = most - self.column.y.abs() + g.R1 * self.column.c - r1;
        (u - size).plus(most).centred_at(value, self.offsets)
    }

    /// The squared chord of the half-angle less that of a rod's angle from its axis.
    fn cone(&self, rod: usize, platform: bool) -> Jet {
        let (d, home) = (&self.domain.machine.mechanism, &self.domain.machine.home);
        let axes = if platform { &home.platform_axes } else { &home.slider_axes };
        let [ax, ay, az] = [axes[0][rod], axes[1][rod], axes[2][rod]];
        let [x, y, z] = self.vectors[rod];
        let along = if platform {
            let [turned_y, turned_z] =
                [self.c.times(ay) - self.s.times(az), self.s.times(ay) + self.c.times(az)];
            x.times(ax) + turned_y * y + turned_z * z
        } else {
            x.times(ax) + y.times(ay) + z.times(az)
        };
        along.times(2.0 * d.inverse_lengths[rod]).plus(self.domain.chords[usize::from(platform)] - 2.0)
    }

    fn determinant(&self) -> Jet {
        let (g, d) = (self.domain.machine.geometry(), &self.domain.machine.mechanism);
        let ratio = g.R2 / g.R1;
        let arms = [1.0, -1.0, -ratio, ratio];
        let m = [0, 1, 2, 3].map(|i| {
            let [x, y, z] = self.vectors[i].map(|part| part.times(d.inverse_lengths[i]));
            [x, y, z, (self.c * z - self.s * y).times(arms[i])]
        });
        determinant(&m)
            .times(self.domain.machine.home.det.signum())
            .plus(-self.domain.machine.limits().parallel_margin)
    }

    /// z - rho of each slider.
    fn sliders(&self) -> [Jet; 3] {
        let q = self.s.times(self.domain.machine.geometry().R2);
        let [w1, w2, w3] = self.drops;
        [w1, q + w2, w3 - q]
    }

    fn stroke(&self, number: usize) -> Jet {
        let (stroke, f) = (&self.domain.machine.limits().stroke, self.sliders());
        let Some(height) = self.domain.height else {
            let (i, j) = PAIRS[number];
            return (f[i] - f[j]).plus(stroke[i][1] - stroke[j][0]);
        };
        let (slider, end) = (number / 2, number % 2);
        let Some(z) = self.at_height(height) else {
            return Jet { value: Interval::ALL, slopes: [Interval::ALL; 2] };
        };
        let over = (z - f[slider]).plus(-stroke[slider][end]);
        if end == 0 { over } else { -over }
    }

    /// The z at which the columns meet a plane of the image's frame; `None` if some column does not meet it.
    fn at_height(&self, height: f64) -> Option<Jet> {
        let level = Jet { value: Interval::of(height), slopes: [Interval::ZERO; 2] };
        match self.domain.image {
            Image::Platform => Some(level),
            Image::Tool { length } => Some(level - self.c.times(length)),
            Image::Part { length, table, phi1: [cp, sp], .. } => {
                let cosine = self.c.times(cp) + self.s.times(sp);
                let sine = self.s.times(cp) - self.c.times(sp);
                let over = (self.y * sine).plus(table.dt - height - length * cp);
                let part = match cosine.value.sign() {
                    1 => over.over(cosine),
                    -1 => (-over).over(-cosine),
                    _ => return None,
                };
                Some(part.plus(table.da))
            }
        }
    }

    fn tilt(&self, end: usize) -> (Jet, bool) {
        let piece = |[sign, offset]: [f64; 2]| self.alpha.times(sign).plus(offset);
        let [a, b] = self.domain.tilt_pieces(end).map(piece);
        a.greater(b)
    }

    /// Height over the floor of the higher of a column's two ends that the strokes leave; and whether it may change
    /// in the box which end that is, or which slider ends the column.
    fn above_table(&self) -> (Jet, bool) {
        let unbounded = Jet { value: Interval::ALL, slopes: [Interval::ALL; 2] };
        let Some(level) = self.domain.floor_level() else { return (unbounded, true) };
        let Image::Part { length, table, phi1: [cp, sp], .. } = self.domain.image else {
            return (unbounded, true);
        };
        let cosine = self.c.times(cp) + self.s.times(sp);
        let sine = self.s.times(cp) - self.c.times(sp);
        let lift = (self.y * sine).plus(table.dt - length * cp - level);
        let (f, stroke) = (self.sliders(), &self.domain.machine.limits().stroke);
        let mut kinked = false;
        let mut greatest = |of: [Jet; 3]| {
            of.into_iter().reduce(|a, b| {
                let (greater, either) = a.greater(b);
                kinked |= either;
                greater
            })
        };
        let low = greatest([0, 1, 2].map(|i| f[i].plus(stroke[i][0])));
        let high = greatest([0, 1, 2].map(|i| -f[i].plus(stroke[i][1]))).map(Neg::neg);
        let (Some(low), Some(high)) = (low, high) else { return (unbounded, true) };
        let height = |z: Jet| lift - z.plus(-table.da) * cosine;
        let (jet, either) = height(low).greater(height(high));
        (jet.centred_at(self.domain.above_table(&self.column), self.offsets), kinked || either)
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
