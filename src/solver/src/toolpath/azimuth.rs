//! Azimuth and inclination of the tool's axis.

use std::f64::consts::{PI, TAU};

use super::motion::{Motion, Turning};
use super::path::Path;
use crate::fast_math::{angle_of, angle_of_vector};

/// Width of the strip beside an azimuth of half a turn whose sign is rounding, rad.
const SEAM: f64 = 1e-9;
/// Fraction of a period below which a difference clearly is the one nearest to zero.
const CLEARLY_NEAREST: f64 = 0.49;
/// Sine of the inclination below which an axis has no azimuth.
pub(super) const LEAST_SINE: f64 = 1e-9;

/// phi1 of an axis on the meridian of this sine and cosine, rad: of its component there, if phi2 is not its own. Also
/// sine and cosine of phi1.
pub(super) fn inclination([i, j, k]: [f64; 3], [sin, cos]: [f64; 2]) -> (f64, [f64; 2]) {
    let across = i * sin - j * cos;
    let length = (k * k + across * across).sqrt();
    if length > 0.0 {
        let direction = [across / length, k / length];
        (angle_of(direction[1], direction[0]), direction)
    } else {
        (0.0, [0.0, 1.0])
    }
}

/// Sine and cosine of phi2 of an axis with phi1 >= 0; `None` at the pole.
#[inline]
pub(super) fn azimuth_direction([i, j, _]: [f64; 3]) -> Option<[f64; 2]> {
    let square = i * i + j * j;
    (square > LEAST_SINE * LEAST_SINE).then(|| {
        let length = square.sqrt();
        [i / length, (0.0 - j) / length]
    })
}

/// The angle of this sine and cosine, rad, in (-π, π] but for rounding.
#[inline]
pub(super) fn azimuth_of([sine, cosine]: [f64; 2]) -> f64 {
    let azimuth = angle_of(cosine, sine);
    if azimuth <= SEAM - PI { azimuth + TAU } else { azimuth }
}

/// phi2 of an axis with phi1 >= 0, rad, in (-π, π] but for rounding; `None` at the pole.
fn azimuth(axis: [f64; 3]) -> Option<f64> {
    azimuth_direction(axis).map(azimuth_of)
}

/// The azimuths of the paths of a program, which begin where the ones before them end.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Azimuths {
    /// The last axis at the end of a path, with its azimuth.
    last: Option<([f64; 3], f64)>,
}

impl Azimuths {
    /// The azimuths at both ends of a part of a path outside the cap. At the pole itself it is that of the way from it.
    pub(super) fn of(&mut self, path: &Path, ends: [f64; 2]) -> [f64; 2] {
        let [start, end] = self.between(ends.map(|s| path.at(s).axis));
        [start.unwrap_or_else(|| way(path, ends[0], 1.0)), end.unwrap_or_else(|| way(path, ends[1], -1.0))]
    }

    /// The azimuths of two axes; `None` at the pole.
    pub(super) fn between(&mut self, [start, end]: [[f64; 3]; 2]) -> [Option<f64>; 2] {
        let known = self.last.filter(|(axis, _)| *axis == start).map(|(_, azimuth)| azimuth);
        let found = azimuth(end);
        self.last = found.map(|azimuth| (end, azimuth));
        [known.or_else(|| azimuth(start)), found]
    }
}

/// The azimuth of the way from the pole.
fn way(path: &Path, s: f64, sign: f64) -> f64 {
    let (_, [_, rate]) = path.with_rates(s);
    let azimuth = angle_of_vector(-sign * rate.y, sign * rate.x);
    if azimuth <= SEAM - PI { azimuth + TAU } else { azimuth }
}

/// The difference modulo `period` that is nearest to zero; of two, the positive one.
#[inline]
pub(super) fn to_nearest(difference: f64, period: f64) -> f64 {
    if difference.abs() < CLEARLY_NEAREST * period {
        return difference;
    }
    difference - period * (difference / period - 0.5 - SEAM).ceil()
}

/// phi2 where a motion of kind [`Arrive`](super::MotionKind::Arrive) ends.
pub(super) fn of_arrival(motion: &Motion) -> f64 {
    match motion.turning {
        Turning::Held { end, .. } => end[1],
        Turning::GreatCircle | Turning::Angles { .. } => azimuth(motion.end.axis).unwrap_or(0.0),
    }
}

/// The value nearest to `before` with this azimuth, modulo half turns.
pub(super) fn continued(before: Option<f64>, azimuth: f64) -> f64 {
    before.map_or(azimuth, |before| before + to_nearest(azimuth - before, PI))
}
