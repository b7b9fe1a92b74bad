//! Every limit over a box: bounds of its values and of its gradient.

use std::ops::Neg;

use super::classification::greatest_along_pairs;
use super::posture_bounds::PostureBounds;
use super::rod_distance::rod_distance;
use crate::jet::Jet;
use crate::parallel_matrix::determinant;
use crate::workspace::domain::{Limit, RodPairs, SLIDER_PAIRS};
use crate::workspace::image::Image;

impl PostureBounds<'_> {
    /// The bounds of one limit that is not of leg I's drop, or of a function of the same sign; and whether it may
    /// have a kink where it vanishes.
    pub(super) fn limit(&self, limit: Limit) -> (Jet, bool) {
        match limit {
            Limit::RodDistance(RodPairs::LegOne) => (self.leg_one_distance(), false),
            Limit::RodDistance(RodPairs::Parallelograms) => self.parallelogram_distance(),
            Limit::RodDistance(_) => rod_distance(self, 2.0 * self.domain.machine.geometry().rod_radius),
            Limit::TablePlane => self.height_over_table(),
            _ => {
                let value = self.domain.with_rods(limit, &self.column, &self.rods);
                (self.uncentred(limit).centred_at(value, self.offsets), false)
            }
        }
    }

    /// The bounds before they are cut with the mean value form.
    fn uncentred(&self, limit: Limit) -> Jet {
        let (g, limits) = (self.domain.machine.geometry(), self.domain.machine.limits());
        match limit {
            Limit::LegSerial(2) => self.squares[0].plus(-(limits.serial_margin * g.L2).powi(2)),
            Limit::LegSerial(_) => self.squares[1].plus(-(limits.serial_margin * g.L3).powi(2)),
            Limit::ParallelSingularity => self.determinant(),
            Limit::SliderCone(rod) => self.cone(usize::from(rod), false),
            Limit::PlatformCone(rod) => self.cone(usize::from(rod), true),
            Limit::Stroke(number) => self.stroke(usize::from(number)),
            Limit::Tilt { high } => self.tilt(high),
            // `LegOneBounds` decides the limits of leg I, and `limit` bounds the other ones.
            Limit::LegOneReach
            | Limit::LegOneCrossing
            | Limit::LegOneSerial(_)
            | Limit::RodDistance(_)
            | Limit::TablePlane => Jet::UNKNOWN,
        }
    }

    /// Leg I's rods begin at one slider, 2 r1 apart along y, and with R1 cos a > r1 they diverge: the
    /// nearest points are a slider end and its foot on the other rod, or that rod's end. Their
    /// distance falls with |y| - u, from 2 r1.
    fn leg_one_distance(&self) -> Jet {
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

    /// The rods of a parallelogram are far enough apart if the leg's extent along the width is small enough.
    /// Parallelograms along x have this limit in the bounds of x instead.
    fn parallelogram_distance(&self) -> (Jet, bool) {
        let d = &self.domain.machine.mechanism;
        let Some(most) = greatest_along_pairs(d) else { return (Jet::constant(-1.0), false) };
        let [c, s] = d.pair_direction;
        let (mut least, mut kinked): (Option<Jet>, bool) = (None, false);
        for (leg, side) in [(0, 1.0), (1, -1.0)] {
            let [x, y, _] = self.vectors[leg + 2];
            let along = x.times(c) + y.times(side * s);
            let at = self.rods.vectors[leg + 2];
            let here = at[0] * c + at[1] * side * s;
            for sign in [1.0, -1.0] {
                let room =
                    along.times(-sign).plus(most[leg]).centred_at(most[leg] - sign * here, self.offsets);
                least = Some(match least {
                    None => room,
                    Some(least) => {
                        let (greater, either) = (-room).greater(-least);
                        kinked |= either;
                        -greater
                    }
                });
            }
        }
        (least.unwrap_or(Jet::UNKNOWN), kinked)
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
            let [x, y, z] = self.vectors[i].map(|component| component.times(d.inverse_lengths[i]));
            [x, y, z, (self.c * z - self.s * y).times(arms[i])]
        });
        determinant(&m)
            .times(self.domain.machine.home.det.signum())
            .plus(-self.domain.machine.limits().parallel_margin)
    }

    fn stroke(&self, number: usize) -> Jet {
        let (stroke, f) = (&self.domain.machine.limits().stroke, self.slider_drops());
        let Some(height) = self.domain.height else {
            let (i, j) = SLIDER_PAIRS[number];
            return (f[i] - f[j]).plus(stroke[i][1] - stroke[j][0]);
        };
        let (slider, end) = (number / 2, number % 2);
        let Some(z) = self.at_height(height) else { return Jet::UNKNOWN };
        let over = (z - f[slider]).plus(-stroke[slider][end]);
        if end == 0 { over } else { -over }
    }

    /// The z at which the columns meet a plane of the image's frame; `None` if some column does not meet it.
    fn at_height(&self, height: f64) -> Option<Jet> {
        let level = Jet::constant(height);
        match self.domain.image {
            Image::Platform => Some(level),
            Image::Tool { length } => Some(level - self.c.times(length)),
            Image::Part { length, table, phi1: [cp, sp], .. } => {
                let cosine = self.c.times(cp) + self.s.times(sp);
                let sine = self.s.times(cp) - self.c.times(sp);
                let over = (self.y * sine).plus(table.dt - height - length * cp);
                let over_axis = match cosine.value.sign() {
                    1 => over.over(cosine),
                    -1 => (-over).over(-cosine),
                    _ => return None,
                };
                Some(over_axis.plus(table.da))
            }
        }
    }

    fn tilt(&self, high: bool) -> Jet {
        let linear = |[slope, offset]: [f64; 2]| self.alpha.times(slope).plus(offset);
        let [a, b] = self.domain.tilt_functions(high).map(linear);
        let (greater, _) = a.greater(b);
        greater
    }

    /// Height over the floor of the higher of a column's two ends that the strokes leave; and whether it may change
    /// in the box which end that is, or which slider ends the column.
    fn height_over_table(&self) -> (Jet, bool) {
        let Some(level) = self.domain.floor_level() else { return (Jet::UNKNOWN, true) };
        let Image::Part { length, table, phi1: [cp, sp], .. } = self.domain.image else {
            return (Jet::UNKNOWN, true);
        };
        let cosine = self.c.times(cp) + self.s.times(sp);
        let sine = self.s.times(cp) - self.c.times(sp);
        let lift = (self.y * sine).plus(table.dt - length * cp - level);
        let (f, stroke) = (self.slider_drops(), &self.domain.machine.limits().stroke);
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
        let (Some(low), Some(high)) = (low, high) else { return (Jet::UNKNOWN, true) };
        let height = |z: Jet| lift - z.plus(-table.da) * cosine;
        let (jet, either) = height(low).greater(height(high));
        (jet.centred_at(self.domain.height_over_table(&self.column), self.offsets), kinked || either)
    }
}
