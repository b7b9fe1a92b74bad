//! Leg I's fold, the curve on which two of its angles merge, in closed form.
//!
//! At constant X1 the platform's y = m sin φ is stationary along leg I's motion where m² R1 cos ψ cos φ = r1 ℓ²
//! sin² φ. With X1² = L1² - ℓ² - m² the curve is a function of φ, up to the signs of X1 and m. For R1 = r1 it is
//! the circle w1 = 0, X1² + y² = L1². The parameter is the angle of (|X1|, |m|), from 0 to π/2.

use std::f64::consts::FRAC_PI_2;

use super::leg_one::{Branch, Shape};
use super::place::Configuration;
use super::request::Space;
use crate::workspace::zero;

/// Places along a quarter at which the legs' reach is examined.
const SAMPLES: u32 = 512;

/// One quarter of the fold.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fold<'a> {
    shape: &'a Shape,
    /// Signs of X1 and m.
    signs: [f64; 2],
    /// Greatest φ, where X1 = 0.
    end: f64,
}

impl<'a> Fold<'a> {
    /// The four quarters; none if leg I reaches nowhere.
    pub(super) fn quarters(shape: &'a Shape) -> Vec<Self> {
        let end = if shape.branch == Branch::Only { last_angle(shape) } else { Some(FRAC_PI_2) };
        let signs = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]];
        end.into_iter().flat_map(|end| signs.map(|signs| Self { shape, signs, end })).collect()
    }

    /// The configuration at a parameter. The heights of legs II and III are zero where they do not reach.
    pub(super) fn at(&self, parameter: f64) -> Configuration {
        let (sin, cos) = parameter.sin_cos();
        let (x, m, third) = if self.shape.branch == Branch::Only {
            let off = |phi: f64| {
                let (x, m) = on_fold(self.shape, phi);
                m * cos - x * sin
            };
            let phi = self.end * zero(off(0.0), off(self.end), 1e-16, |part| off(part * self.end));
            // At both ends one of them is exactly zero.
            let (x, m) = on_fold(self.shape, phi);
            let length = x.hypot(m);
            (length * cos, length * sin, phi)
        } else {
            let length = self.shape.squares[0].sqrt();
            (length * cos, length * sin, 0.0)
        };
        let mut q = [self.signs[0] * x, self.signs[1] * m, third, 0.0, 0.0];
        let squares = self.shape.place(&q).height_squares();
        q[3] = squares[0].max(0.0).sqrt();
        q[4] = squares[1].max(0.0).sqrt();
        q
    }

    pub(super) fn between(&self, a: &Configuration, b: &Configuration, fraction: f64) -> Configuration {
        let [from, to] = [a, b].map(|q| q[1].abs().atan2(q[0].abs()));
        self.at(from + (to - from) * fraction)
    }

    pub(super) fn image(&self, q: &Configuration) -> [f64; 2] {
        self.shape.image(Space::Platform, q)
    }

    pub(super) fn direction(&self, q: &Configuration) -> [f64; 2] {
        if self.shape.branch == Branch::Only {
            [self.signs[1] * ratio(self.shape, q[2]), -q[0]]
        } else {
            [q[1], -q[0]]
        }
    }

    /// The parts of the quarter on which legs II and III reach.
    pub(super) fn parts(&self) -> Vec<[f64; 2]> {
        let reserve = |parameter: f64| {
            let [second, third] = self.shape.place(&self.at(parameter)).height_squares();
            second.min(third)
        };
        let at = |i: u32| FRAC_PI_2 * f64::from(i) / f64::from(SAMPLES);
        let mut parts = Vec::new();
        let mut before = reserve(0.0);
        let mut start = (before >= 0.0).then_some(0.0);
        for i in 0..SAMPLES {
            let ([from, to], after) = ([at(i), at(i + 1)], reserve(at(i + 1)));
            if (before >= 0.0) != (after >= 0.0) {
                let part = zero(before, after, 1e-15, |part| reserve(from + part * (to - from)));
                let border = from + part * (to - from);
                match start.take() {
                    Some(start) => parts.push([start, border]),
                    None => start = Some(border),
                }
            }
            before = after;
        }
        parts.extend(start.map(|start| [start, FRAC_PI_2]));
        parts
    }
}

/// m / sin φ on the fold.
fn ratio(shape: &Shape, phi: f64) -> f64 {
    let angles = shape.angles(phi);
    angles.arm[0] * (shape.r1 / (shape.R1 * angles.cos_psi[0] * angles.cos_phi[0])).sqrt()
}

/// X1² on the fold.
fn square(shape: &Shape, phi: f64) -> f64 {
    let arm = shape.angles(phi).arm[0];
    shape.squares[0] - arm * arm - (ratio(shape, phi) * phi.sin()).powi(2)
}

/// |X1| and |m| on the fold.
fn on_fold(shape: &Shape, phi: f64) -> (f64, f64) {
    (square(shape, phi).max(0.0).sqrt(), ratio(shape, phi) * phi.sin())
}

/// The greatest φ on the fold, where X1 = 0: m tends to infinity at π/2.
fn last_angle(shape: &Shape) -> Option<f64> {
    if square(shape, 0.0) <= 0.0 {
        return None;
    }
    let (mut low, mut high) = (0.0, FRAC_PI_2);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if square(shape, middle) >= 0.0 { low = middle } else { high = middle }
    }
    Some(low)
}
