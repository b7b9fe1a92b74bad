//! Sines and cosines of a posture's angles.

use std::f64::consts::FRAC_PI_2;

use crate::fast_math::sin_cos;
use crate::pose::TableAngles;

/// Sine and cosine of alpha, theta1 and theta2.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turns {
    pub(crate) platform: [f64; 2],
    pub(crate) tilt: [f64; 2],
    pub(crate) rotary: [f64; 2],
}

impl Turns {
    /// The turns in the middle between two positions of the table, where the platform has this alpha.
    pub(crate) fn in_middle([a, b]: [TableAngles; 2], turns: [&Self; 2], alpha: f64) -> Self {
        let tilt = halfway([a.theta1, b.theta1], turns.map(|turns| turns.tilt));
        let rotary = halfway([a.theta2, b.theta2], turns.map(|turns| turns.rotary));
        Self { platform: direction(alpha), tilt, rotary }
    }

    pub(crate) fn of(alpha: f64, table: TableAngles) -> Self {
        let [platform, tilt, rotary] = [alpha, table.theta1, table.theta2].map(direction);
        Self { platform, tilt, rotary }
    }

    /// The tool's axis in the part frame.
    pub(crate) fn axis(&self) -> [f64; 3] {
        let ([s1, c1], [s2, c2]) = (self.inclination(), self.rotary);
        // phi2 = -theta2.
        [-s1 * s2, -s1 * c2, c1]
    }

    /// Sine and cosine of phi1.
    pub(crate) fn inclination(&self) -> [f64; 2] {
        difference(self.platform, self.tilt)
    }
}

/// Sine and cosine of an angle.
pub(crate) fn direction(angle: f64) -> [f64; 2] {
    let (sine, cosine) = sin_cos(angle);
    [sine, cosine]
}

/// Sine and cosine of the mean of two angles, of which sine and cosine are known.
fn halfway([a, b]: [f64; 2], [[sa, ca], [sb, cb]]: [[f64; 2]; 2]) -> [f64; 2] {
    if (b - a).abs() > FRAC_PI_2 {
        return direction(0.5 * (a + b));
    }
    let (sine, cosine) = (sa + sb, ca + cb);
    let scale = 1.0 / (sine * sine + cosine * cosine).sqrt();
    [sine * scale, cosine * scale]
}

/// Sine and cosine of the difference of two angles.
pub(crate) fn difference([sa, ca]: [f64; 2], [sb, cb]: [f64; 2]) -> [f64; 2] {
    [sa * cb - ca * sb, ca * cb + sa * sb]
}
