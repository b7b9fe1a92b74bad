//! Postures that reach a pose, by brute force.
//!
//! In every frame the platform's position is a path: x is fixed, (y, z) runs on a circle with
//! alpha. Leg I leaves w1 = ± sqrt(L1² - X1² - y² - u² - v²) from its mean and y u + w1 v = 0 from
//! its difference; legs II and III then have two slider positions each.

use nalgebra::{Matrix4, Vector2, Vector4};
use verne_solver::{Machine, PartPose};

use super::angle_roots::{curves, zeros};
use super::legs::Legs;
use super::polish;
use super::solution::{Answer, Found};

/// The platform's position as a function of alpha: (y, z) = center + cosine cos(alpha) + sine sin(alpha).
#[derive(Clone, Copy)]
pub(crate) struct Path {
    x: f64,
    center: Vector2<f64>,
    cosine: Vector2<f64>,
    sine: Vector2<f64>,
}

impl Path {
    /// P given in the base frame.
    pub(crate) fn platform(p: [f64; 3]) -> Self {
        Self::sampled(|_| p)
    }

    /// The tool centre point given in the base frame.
    pub(crate) fn tool(tip: [f64; 3], tool_length: f64) -> Self {
        Self::sampled(|alpha| {
            [tip[0], tip[1] + tool_length * alpha.sin(), tip[2] - tool_length * alpha.cos()]
        })
    }

    /// The tool given in the table frame: the table tilts by alpha - phi1 (Eqs (7), (9), (14)).
    pub(crate) fn part(machine: &Machine, target: &PartPose, tool_length: f64) -> Self {
        let tip = Vector4::new(target.x, target.y, target.z, 1.0);
        Self::sampled(|alpha| {
            let table = table(machine, alpha - target.phi1, -target.phi2);
            let platform = table * tip - about_x(alpha) * Vector4::new(0.0, 0.0, tool_length, 0.0);
            [platform.x, platform.y, platform.z]
        })
    }

    fn sampled(platform: impl Fn(f64) -> [f64; 3]) -> Self {
        use std::f64::consts::{FRAC_PI_2, PI};
        let at = |alpha: f64| Vector2::new(platform(alpha)[1], platform(alpha)[2]);
        let center = (at(0.0) + at(PI)) / 2.0;
        Self {
            x: platform(0.0)[0],
            center,
            cosine: (at(0.0) - at(PI)) / 2.0,
            sine: (at(FRAC_PI_2) - at(-FRAC_PI_2)) / 2.0,
        }
    }

    /// x, y, z, alpha.
    pub(crate) fn pose(&self, alpha: f64) -> Vector4<f64> {
        let yz = self.center + self.cosine * alpha.cos() + self.sine * alpha.sin();
        Vector4::new(self.x, yz[0], yz[1], alpha)
    }

    /// Rates of y and z with alpha.
    pub(crate) fn velocity(&self, alpha: f64) -> Vector2<f64> {
        self.sine * alpha.cos() - self.cosine * alpha.sin()
    }
}

/// The table frame in the base frame, Eq (7), factor by factor.
fn table(machine: &Machine, theta1: f64, theta2: f64) -> Matrix4<f64> {
    let offsets = &machine.data().table;
    let along_z = |d: f64| Matrix4::new_translation(&nalgebra::Vector3::new(0.0, 0.0, d));
    let half_turn = Matrix4::from_diagonal(&Vector4::new(1.0, -1.0, -1.0, 1.0));
    along_z(offsets.da) * about_x(theta1) * along_z(offsets.dt) * half_turn * about_z(theta2)
}

fn about_x(angle: f64) -> Matrix4<f64> {
    let (s, c) = angle.sin_cos();
    #[rustfmt::skip]
    let matrix = Matrix4::new(
        1.0, 0.0, 0.0, 0.0,
        0.0, c, -s, 0.0,
        0.0, s, c, 0.0,
        0.0, 0.0, 0.0, 1.0,
    );
    matrix
}

fn about_z(angle: f64) -> Matrix4<f64> {
    let (s, c) = angle.sin_cos();
    #[rustfmt::skip]
    let matrix = Matrix4::new(
        c, -s, 0.0, 0.0,
        s, c, 0.0, 0.0,
        0.0, 0.0, 1.0, 0.0,
        0.0, 0.0, 0.0, 1.0,
    );
    matrix
}

/// All postures on a path.
pub(crate) fn inverse(machine: &Machine, path: &Path) -> Answer {
    let legs = Legs::of(machine);
    let mut answer = Answer::default();
    let (curves, grazes) = curves(|alpha| discriminant(&legs, path, alpha));
    for curve in curves {
        let zeros = zeros(|t| {
            let (alpha, sign) = curve.at(t);
            difference(&legs, path, alpha, sign)
        });
        answer.continuum |= zeros.vanishes;
        answer.touches.extend(zeros.touches.iter().map(|&t| path.pose(curve.at(t).0)));
        for (alpha, sign) in zeros.crossings.iter().map(|&t| curve.at(t)) {
            let rho1 = path.pose(alpha)[2] - legs.scale() * rise(&legs, path, alpha, sign);
            let (alpha, rho1, amplification) = polish::inverse(&legs, path, alpha, rho1);
            legs_two_and_three(&legs, path, alpha, rho1, amplification, &mut answer);
        }
    }
    let solves = |alpha: f64| difference(&legs, path, alpha, 0.0).abs() < 1e-5;
    answer.touches.extend(grazes.into_iter().filter(|&a| solves(a)).map(|a| path.pose(a)));
    answer
}

/// (w1 / scale)² as leg I's mean gives it.
fn discriminant(legs: &Legs, path: &Path, alpha: f64) -> f64 {
    let (g, q) = (&legs.g, path.pose(alpha));
    let x1 = q[0] + (g.D1 - g.d1);
    let lever2 = (g.R1 - g.r1).powi(2) + 2.0 * g.R1 * g.r1 * (1.0 - alpha.cos());
    ((g.L1 - x1) * (g.L1 + x1) - q[1] * q[1] - lever2) / legs.scale().powi(2)
}

/// w1 / scale.
fn rise(legs: &Legs, path: &Path, alpha: f64, sign: f64) -> f64 {
    sign * discriminant(legs, path, alpha).max(0.0).sqrt()
}

/// y u + w1 v, in units of the scale.
fn difference(legs: &Legs, path: &Path, alpha: f64, sign: f64) -> f64 {
    let (g, unit) = (&legs.g, legs.scale());
    let (u, v) = ((g.R1 * alpha.cos() - g.r1) / unit, g.R1 * alpha.sin() / unit);
    path.pose(alpha)[1] / unit * u + rise(legs, path, alpha, sign) * v
}

/// Both choices each of legs II and III, where they reach.
fn legs_two_and_three(
    legs: &Legs,
    path: &Path,
    alpha: f64,
    rho1: f64,
    amplification: f64,
    answer: &mut Answer,
) {
    let (g, q) = (&legs.g, path.pose(alpha));
    let swing = (path.velocity(alpha).norm() + g.R2 + g.R1) / g.R1;
    let reach = |rod: u8| {
        let (d, length) = (legs.rod(rod, &q, &[0.0; 3]), legs.length(rod));
        let across = d.x.hypot(d.y);
        (d.z, (length - across) * (length + across) / legs.scale().powi(2))
    };
    let ((top2, under2), (top3, under3)) = (reach(21), reach(31));
    // The two slider positions of a leg merge if the leg is stretched across the guideways.
    if under2.min(under3) < 1e-10 {
        if under2.min(under3) > -1e-10 {
            answer.touches.push(q);
        }
        return;
    }
    let (drop2, drop3) = (under2.sqrt(), under3.sqrt());
    let amplification = amplification * swing * (1.0 + 1.0 / drop2.min(drop3));
    for (s2, s3) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
        let rho = [rho1, top2 - s2 * drop2 * legs.scale(), top3 - s3 * drop3 * legs.scale()];
        answer.found.push(Found::new(legs, q, rho, amplification));
    }
}
