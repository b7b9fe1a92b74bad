//! Postures that are constructed instead of searched: alpha is chosen and the rest follows in closed form.

use nalgebra::Vector4;
use verne_solver::Machine;

use super::legs::Legs;
use super::solution::Found;
use crate::lengths::scale;
use crate::random::Random;

/// Leg I at a chosen alpha (not 0 or π) and y: x and rho1 follow, x on the chosen side of leg I's
/// guideway. `None` out of reach.
pub(crate) fn leaning(legs: &Legs, alpha: f64, y: f64, z: f64, side: f64) -> Option<(Vector4<f64>, f64)> {
    let g = &legs.g;
    let (u, v) = (g.R1 * alpha.cos() - g.r1, g.R1 * alpha.sin());
    let w1 = -y * u / v;
    let x1 = (g.L1 * g.L1 - y * y - u * u - v * v - w1 * w1).sqrt();
    x1.is_finite().then(|| (Vector4::new(side * x1 - (g.D1 - g.d1), y, z, alpha), z - w1))
}

/// Leg I in the symmetry plane, alpha 0 or π, at a chosen x, its slider above (+1) or below (-1).
pub(crate) fn upright(legs: &Legs, alpha: f64, x: f64, z: f64, s1: f64) -> Option<(Vector4<f64>, f64)> {
    let g = &legs.g;
    let (x1, u) = (x + (g.D1 - g.d1), g.R1 * alpha.cos() - g.r1);
    let w1 = s1 * (g.L1 * g.L1 - x1 * x1 - u * u).sqrt();
    w1.is_finite().then(|| (Vector4::new(x, 0.0, z, alpha), z - w1))
}

/// The height of legs II and III over the platform, squared: negative out of reach.
pub(crate) fn drops_squared(legs: &Legs, q: &Vector4<f64>) -> [f64; 2] {
    [21, 31].map(|rod| {
        let (d, length) = (legs.rod(rod, q, &[0.0; 3]), legs.length(rod));
        let across = d.x.hypot(d.y);
        (length - across) * (length + across)
    })
}

/// Hangs the platform on legs II and III, their sliders above (+1) or below (-1). `None` out of
/// reach.
pub(crate) fn hung(legs: &Legs, (q, rho1): (Vector4<f64>, f64), sides: [f64; 2]) -> Option<Found> {
    let [under2, under3] = drops_squared(legs, &q);
    let [top2, top3] = [21, 31].map(|rod| legs.rod(rod, &q, &[0.0; 3]).z);
    let rho = [rho1, top2 - sides[0] * under2.sqrt(), top3 - sides[1] * under3.sqrt()];
    let reached = rho[1].is_finite() && rho[2].is_finite();
    reached.then(|| Found::new(legs, q, rho, 1.0 / legs.rates(&q, &rho).singular_values()[3]))
}

/// Random postures of random machines.
pub(crate) fn postures(seed: u64, wanted: usize) -> Vec<(Machine, Found)> {
    let mut draw = Random::new(seed);
    let mut found = Vec::new();
    while found.len() < wanted {
        let machine = draw.any_machine();
        let (legs, unit) = (Legs::of(&machine), scale(&machine));
        let (alpha, y) = (draw.between(-3.0, 3.0) * draw.pick(&[0.1, 1.0]), unit * draw.between(-0.5, 0.5));
        let y = y * alpha.sin().abs();
        let sides = [draw.pick(&[1.0, 1.0, -1.0]), draw.pick(&[1.0, 1.0, -1.0])];
        let leg1 = leaning(&legs, alpha, y, unit * draw.between(0.5, 2.0), draw.pick(&[1.0, -1.0]));
        if let Some(posture) = leg1.and_then(|leg1| hung(&legs, leg1, sides)) {
            found.push((machine, posture));
        }
    }
    found
}
