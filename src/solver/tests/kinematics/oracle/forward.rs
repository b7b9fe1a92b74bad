//! Assembly modes by brute force.
//!
//! For each alpha the rods of leg I, by their difference, leave (y, z - rho1) = λ (-v, u). Legs I,
//! II and III together give x linearly in λ, and leg I then a quadratic for λ whose leading
//! coefficient never vanishes. What remains, the difference of legs II and III, is λ D - N, to be
//! zero on either root λ.

use nalgebra::Vector4;
use verne_solver::Machine;

use super::angle_roots::{curves, zeros};
use super::legs::Legs;
use super::polish;
use super::solution::{Answer, Found};

struct System<'a> {
    legs: &'a Legs,
    rho: [f64; 3],
}

/// The values of the equations at one alpha, with lengths in units of the machine's scale.
struct Slice {
    u: f64,
    v: f64,
    /// u² + v².
    lever2: f64,
    /// X1 = base + slope λ.
    base: f64,
    slope: f64,
    /// λ D - N = 0.
    d: f64,
    n: f64,
    discriminant: f64,
}

/// All assembly modes for slider positions.
pub(crate) fn forward(machine: &Machine, rho: [f64; 3]) -> Answer {
    let legs = Legs::of(machine);
    let system = System { legs: &legs, rho };
    let mut answer = Answer::default();
    let (curves, grazes) = curves(|a| system.slice(a).discriminant);
    for curve in curves {
        let zeros = zeros(|t| {
            let (alpha, sign) = curve.at(t);
            let slice = system.slice(alpha);
            slice.lambda(sign) * slice.d - slice.n
        });
        answer.continuum |= zeros.vanishes;
        let pose = |t: &f64| system.pose(curve.at(*t));
        answer.touches.extend(zeros.touches.iter().map(pose));
        for start in zeros.crossings.iter().map(pose) {
            let (q, amplification) = polish::forward(&legs, start, &rho);
            answer.found.push(Found::new(&legs, q, rho, amplification));
        }
    }
    let solves = |&a: &f64| {
        let slice = system.slice(a);
        (slice.lambda(0.0) * slice.d - slice.n).abs() < 1e-5
    };
    answer.touches.extend(grazes.iter().filter(|a| solves(a)).map(|&a| system.pose((a, 0.0))));
    keep_one_working(&legs, &mut answer.found);
    answer
}

/// Of several modes with all sliders above and uncrossed rods, those on home's side of the singularity are working, if
/// there is one.
fn keep_one_working(legs: &Legs, found: &mut [Found]) {
    if found.iter().filter(|found| found.working).count() < 2 {
        return;
    }
    let g = &legs.g;
    let height = |length: f64, x: f64, y: f64| (length * length - x * x - y * y).sqrt();
    let [e1, e2] = [g.D1 - g.d1, g.D2 - g.d2];
    let heights =
        [height(g.L1, e1, g.R1 - g.r1), height(g.L2, e2, g.R2 - g.r4), height(g.L3, e2, g.R2 - g.r4)];
    let home = legs.rates(&Vector4::zeros(), &heights.map(|height| -height)).determinant();
    // With nearly equal offsets x = -e separates two mirror images.
    let nearly_equal = (e1 - e2).abs() < 1e-2 * g.L1.max(g.L2).max(g.L3);
    let is_home = |found: &Found| {
        let beside = !nearly_equal || (2.0 * found.q[0] + e1 + e2) * (e1 + e2) > 0.0;
        found.working && beside && legs.rates(&found.q, &found.rho).determinant() * home > 0.0
    };
    if found.iter().any(is_home) {
        for found in found.iter_mut() {
            found.working = is_home(found);
        }
    }
}

impl System<'_> {
    fn slice(&self, alpha: f64) -> Slice {
        let (g, unit) = (&self.legs.g, self.legs.scale());
        let (s, c) = alpha.sin_cos();
        let [big1, small1, big2, small4] = [g.R1, g.r1, g.R2, g.r4].map(|length| length / unit);
        let [l1, l2, l3] = [g.L1, g.L2, g.L3].map(|length| length / unit);
        let (u, v, p, q) = (big1 * c - small1, big1 * s, big2 * c - small4, big2 * s);
        let lever2 = (big1 - small1).powi(2) + 2.0 * big1 * small1 * (1.0 - c);
        let (e1, e2) = ((g.D1 - g.d1) / unit, (g.D2 - g.d2) / unit);
        // Heights of slider 1 over sliders 2 and 3, and of slider 3 over slider 2.
        let [to2, to3] = [1, 2].map(|i| (self.rho[0] - self.rho[i]) / unit);
        let across = (self.rho[2] - self.rho[1]) / unit;
        let (h2, h3) = (to2 - q, to3 + q);
        // Legs II and III less leg I, halved: 2 (e2 - e1) x + ... + w1 (h2 + h3) + ... = 0, w1 = λ u.
        let rest = p * p + f64::midpoint(h2 * h2, h3 * h3) - f64::midpoint(l2 * l2, l3 * l3)
            + (l1 * l1 - lever2)
            + (e2 * e2 - e1 * e1);
        let (base, slope) = (e1 + rest / (2.0 * (e1 - e2)), u * (to2 + to3) / (2.0 * (e1 - e2)));
        let m = across - 2.0 * q;
        Slice {
            u,
            v,
            lever2,
            base,
            slope,
            d: 4.0 * s * (big2 * small1 - big1 * small4) + 2.0 * across * u,
            n: (l2 - l3) * (l2 + l3) - m * (to2 + to3),
            discriminant: (l1 * l1 - lever2) * (slope * slope + lever2) - lever2 * base * base,
        }
    }

    fn pose(&self, (alpha, sign): (f64, f64)) -> Vector4<f64> {
        let (g, unit, slice) = (&self.legs.g, self.legs.scale(), self.slice(alpha));
        let lambda = slice.lambda(sign);
        let x1 = unit * (slice.base + slice.slope * lambda);
        let (y, w1) = (-unit * lambda * slice.v, unit * lambda * slice.u);
        Vector4::new(x1 - (g.D1 - g.d1), y, self.rho[0] + w1, alpha)
    }
}

impl Slice {
    fn lambda(&self, sign: f64) -> f64 {
        let root = sign * self.discriminant.max(0.0).sqrt();
        (root - self.base * self.slope) / (self.slope * self.slope + self.lever2)
    }
}
