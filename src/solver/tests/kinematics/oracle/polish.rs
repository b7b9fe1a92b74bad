//! Newton's method on the lengths of the rods.

use nalgebra::{Matrix2, Vector2, Vector4};

use super::inverse::Path;
use super::legs::Legs;

/// Polishes x, y, z, alpha for given sliders. Returns the pose with the least errors and their
/// amplification: the error of the pose, alpha on the lever R1, for an error of a rod's length.
pub(crate) fn forward(legs: &Legs, start: Vector4<f64>, rho: &[f64; 3]) -> (Vector4<f64>, f64) {
    let lever = Vector4::new(1.0, 1.0, 1.0, 1.0 / legs.g.R1);
    let mut best = (legs.residual(&start, rho), start);
    let mut q = start;
    for _ in 0..12 {
        let Some(inverse) = legs.rates(&q, rho).try_inverse() else { break };
        q -= (inverse * legs.errors(&q, rho)).component_mul(&lever);
        let residual = legs.residual(&q, rho);
        if residual < best.0 {
            best = (residual, q);
        }
    }
    let smallest = legs.rates(&best.1, rho).singular_values()[3];
    (best.1, 1.0 / smallest)
}

/// Polishes alpha and rho1 on the two rods of leg I, the platform bound to a path. Returns both
/// and the amplification of errors.
pub(crate) fn inverse(legs: &Legs, path: &Path, alpha: f64, rho1: f64) -> (f64, f64, f64) {
    let mut best = (f64::INFINITY, alpha, rho1);
    let (mut a, mut r) = (alpha, rho1);
    for _ in 0..12 {
        let (errors, rates) = leg1(legs, path, a, r);
        if errors.amax() < best.0 {
            best = (errors.amax(), a, r);
        }
        let Some(inverse) = rates.try_inverse() else { break };
        let step = inverse * errors;
        a -= step[0] / legs.g.R1;
        r -= step[1];
    }
    let smallest = leg1(legs, path, best.1, best.2).1.singular_values()[1];
    (best.1, best.2, 1.0 / smallest)
}

/// Errors of rods 11 and 12, and their rates with R1 alpha (along the path) and rho1.
fn leg1(legs: &Legs, path: &Path, alpha: f64, rho1: f64) -> (Vector2<f64>, Matrix2<f64>) {
    let q = path.pose(alpha);
    let rho = [rho1; 3];
    let errors = legs.errors(&q, &rho);
    let rates = legs.rates(&q, &rho);
    let moving = path.velocity(alpha) / legs.g.R1;
    let along = |row: usize| rates[(row, 1)] * moving[0] + rates[(row, 2)] * moving[1] + rates[(row, 3)];
    let sliding = legs.slider_rates(&q, &rho);
    let rates = Matrix2::new(along(0), sliding[0][0], along(1), sliding[1][0]);
    (Vector2::new(errors[0], errors[1]), rates)
}
