//! Angles (φ, θ) that describe every position of leg I, and the equations of legs II and III in them.
//!
//! With (y, w1) = m (sin φ, cos φ) the first of equations (A) is R1 sin(a + φ) = r1 sin φ. So φ determines a, and the
//! second of (A) is a circle in (X1, m):
//!
//! ```text
//! a = asin(r1/R1 · sin φ) - φ        X1 = √E sin θ,  m = √E cos θ,  E = L1² - (R1 - r1)² - k (1 - cos a)
//! ```
//!
//! The rate da/dφ is within [-2, 0] for all R1 ≥ r1. With R1 = r1 the half circle cos φ > 0 has a = 0, the branch on
//! which the platform does not turn, and the other half has a = ±π - 2φ, the branch of crossed rods. Half the
//! difference of Eqs (5) and (6), and their mean less that of (3) and (4), are then
//!
//! ```text
//! 2 m ((A - B - 2q) cos φ - 2p sin φ) - N = 0        2 (e1 - e2) X1 - m cos φ S - T = 0
//! ```
//!
//! with A = rho1 - rho2 and B = rho1 - rho3. Nothing is divided by R1 - r1 or by e1 - e2. The derivatives are regular
//! wherever det_P is not zero, except at E = 0.

use crate::interval::Interval;
use crate::jet::Jet;
use crate::mechanism::Mechanism;
use crate::pose::PlatformPose;

/// Least E that is distinguished from zero, over L1².
const LEAST_RADIUS: f64 = 1e-12;

/// The equations for given sliders.
#[derive(Clone, Copy, Debug)]
pub(super) struct LegOneChart {
    rho1: f64,
    e1: f64,
    /// r1/R1, and 1 - (r1/R1)² without cancellation.
    ratio: f64,
    complement: f64,
    /// R2 and r4.
    arms: [f64; 2],
    /// E = e[0] + e[1] cos a.
    e: [f64; 2],
    /// T = t[0] + t[1] cos a + t[2] sin a.
    t: [f64; 3],
    /// A - B and S.
    gap: f64,
    s: f64,
    /// L2² - L3².
    k: f64,
    /// 2 (e1 - e2).
    d: f64,
    least: f64,
    /// Magnitudes of both equations' terms.
    pub(super) magnitudes: [f64; 2],
}

impl LegOneChart {
    pub(super) fn new(mechanism: &Mechanism, rho: [f64; 3]) -> Self {
        let g = &mechanism.geometry;
        let [a, b] = [rho[0] - rho[1], rho[0] - rho[2]];
        let (gap, s, offset) = (rho[2] - rho[1], a + b, mechanism.e1 - mechanism.e2);
        let e = [g.L1 * g.L1 - mechanism.gap_square - mechanism.k, mechanism.k];
        let t0 = g.R2 * g.R2 + g.r4 * g.r4 - 0.5 * (g.L2 * g.L2 + g.L3 * g.L3)
            + e[0]
            + 0.5 * (a * a + b * b)
            + offset * offset;
        let (k, arm) = ((g.L2 - g.L3) * (g.L2 + g.L3), g.R2 + g.r4);
        let squares = arm * arm + g.L2 * g.L2 + g.L3 * g.L3 + e[0].abs() + e[1] + a * a + b * b;
        Self {
            rho1: rho[0],
            e1: mechanism.e1,
            ratio: g.r1 / g.R1,
            complement: (g.R1 - g.r1) * (g.R1 + g.r1) * mechanism.inverse_r1_square,
            arms: [g.R2, g.r4],
            e,
            t: [t0, e[1] - 2.0 * g.R2 * g.r4, -g.R2 * gap],
            gap,
            s,
            k,
            d: 2.0 * offset,
            least: LEAST_RADIUS * g.L1 * g.L1,
            magnitudes: [
                2.0 * g.L1 * (gap.abs() + 4.0 * arm) + k.abs() + (gap.abs() + 2.0 * g.R2) * s.abs(),
                g.L1 * (2.0 * offset.abs() + s.abs()) + squares + g.R2 * gap.abs() + offset * offset,
            ],
        }
    }

    /// Both equations over a box of angles, with their derivatives along φ and θ; `None` if leg I closes at no angle φ
    /// of the box.
    pub(super) fn equations(&self, [phi, theta]: [Interval; 2]) -> Option<[Jet; 2]> {
        let [c, s] = Jet::coordinate(phi, 0).cosine_and_sine();
        let [cos_a, sin_a] = self.platform_angle_over(phi, c.value).cosine_and_sine();
        let square = cos_a.times(self.e[1]).plus(self.e[0]);
        if square.value.high < 0.0 {
            return None;
        }
        let radius = square.root(self.least);
        let [cos_theta, sin_theta] = Jet::coordinate(theta, 1).cosine_and_sine();
        let [r2, r4] = self.arms;
        let (p, spread) = (cos_a.times(r2).plus(-r4), sin_a.times(-2.0 * r2).plus(self.gap));
        let m = radius * cos_theta;
        let across = (c * spread - p * s.times(2.0)).times(2.0);
        let t = cos_a.times(self.t[1]) + sin_a.times(self.t[2]);
        Some([
            m * across + spread.times(self.s).plus(-self.k),
            (radius * sin_theta).times(self.d) - (m * c).times(self.s) - t.plus(self.t[0]),
        ])
    }

    /// The platform's pose at two angles; `None` where leg I does not close.
    pub(super) fn pose(&self, [phi, theta]: [f64; 2]) -> Option<PlatformPose> {
        let (s, c) = phi.sin_cos();
        let alpha = self.platform_angle(phi);
        let square = self.e[0] + self.e[1] * alpha.cos();
        let radius = (square > -self.least).then(|| square.max(0.0).sqrt())?;
        let (x1, m) = (radius * theta.sin(), radius * theta.cos());
        Some(PlatformPose { x: x1 - self.e1, y: m * s, z: self.rho1 + m * c, alpha })
    }

    /// alpha at an angle φ.
    fn platform_angle(&self, phi: f64) -> f64 {
        let (s, c) = phi.sin_cos();
        let cosine = (self.complement + self.ratio * self.ratio * c * c).sqrt();
        if c > 0.0 {
            // sin(a) without cancellation where a is small.
            let sine = -s * self.complement / (self.ratio * c + cosine);
            let cosine = cosine * c + self.ratio * s * s;
            sine.atan2(cosine)
        } else {
            (self.ratio * s).atan2(cosine) - phi
        }
    }

    /// alpha over an interval of φ within a turn, from the interval of cos φ. It falls as φ rises.
    fn platform_angle_over(&self, phi: Interval, cosine: Interval) -> Jet {
        let angle = |phi: f64| {
            let (s, c) = phi.sin_cos();
            (self.ratio * s).atan2((self.complement + self.ratio * self.ratio * c * c).sqrt()) - phi
        };
        let rate = |c: f64| {
            let x = self.ratio * c;
            let length = (self.complement + x * x).sqrt();
            if length > 0.0 { x / length } else { 0.0 }
        };
        // At R1 = r1 the rate has a step at cos φ = 0.
        let step = |rate: f64, side: f64| if self.complement == 0.0 && rate == 0.0 { side } else { rate };
        let rates = Interval::new(step(rate(cosine.low), -1.0), step(rate(cosine.high), 1.0)).plus(-1.0);
        Jet { value: Interval::new(angle(phi.high), angle(phi.low)), slopes: [rates, Interval::ZERO] }
    }
}
