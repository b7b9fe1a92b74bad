//! General root finders of degree eight, on the polynomial of the forward problem in tan(a/2).
//!
//! They compute less than the solver: roots of a polynomial that is already built, without poses, labels, polishing
//! or a check.

use aberth::aberth;
use arrayvec::ArrayVec;
use nalgebra::SMatrix;
use polycool::Poly;
use verne_solver::{Machine, forward};

use crate::inputs::Inputs;
use crate::polynomial::{Octic, octic};

/// Size of the last step of the iterative finders. Their convergence is quadratic or better: the errors are between
/// 1e-11 and 1e-13, and none is faster with a larger step.
const ACCURACY: f64 = 1e-8;
/// Within this of the real axis a complex root counts as real.
const REAL: f64 = 1e-6;
/// Difference of t at which a root counts as found, relative to 1 + t².
const FOUND: f64 = 1e-5;

/// The real roots, in some order.
pub(crate) type Roots = ArrayVec<f64, 16>;
/// A finder and its row in the table.
pub(crate) type Finder = (&'static str, fn(&Octic) -> Roots);

/// All finders that are timed.
pub(crate) const FINDERS: [Finder; 3] = [
    ("roots of degree 8: companion matrix, Schur (nalgebra)", companion),
    ("roots of degree 8: Aberth-Ehrlich (aberth)", aberth_ehrlich),
    ("roots of degree 8: Yuksel, real only (polycool)", yuksel),
];

/// Eigenvalues of the companion matrix.
pub(crate) fn companion(octic: &Octic) -> Roots {
    let scale = -1.0 / octic[8];
    let matrix = SMatrix::<f64, 8, 8>::from_fn(|row, column| {
        if column == 7 {
            octic[row] * scale
        } else if row == column + 1 {
            1.0
        } else {
            0.0
        }
    });
    let values = matrix.complex_eigenvalues();
    values.iter().filter(|z| z.im.abs() <= REAL * (1.0 + z.re * z.re)).map(|z| z.re).collect()
}

/// All complex roots at once.
pub(crate) fn aberth_ehrlich(octic: &Octic) -> Roots {
    let found = aberth(octic, 60, ACCURACY);
    found.iter().filter(|z| z.im.abs() <= REAL * (1.0 + z.re * z.re)).map(|z| z.re).collect()
}

/// Real roots between the extrema, in [-1, 1] and, with the coefficients reversed, outside it.
pub(crate) fn yuksel(octic: &Octic) -> Roots {
    let mut reversed = *octic;
    reversed.reverse();
    let mut roots: Roots = Poly::new(*octic).roots_between(-1.0, 1.0, ACCURACY).into_iter().collect();
    let inverse = Poly::new(reversed).roots_between(-1.0, 1.0, ACCURACY);
    roots.extend(inverse.into_iter().filter(|t| t.abs() < 1.0).map(f64::recip));
    roots
}

/// Counts how many of the solver's assembly modes each finder's roots contain. It stops if the polynomial does not
/// have the solver's roots.
pub(crate) fn check(machine: &Machine, inputs: &Inputs) -> Vec<(&'static str, usize, usize)> {
    let count = |finder: fn(&Octic) -> Roots| {
        let (mut modes, mut found) = (0, 0);
        for &rho in &inputs.rho {
            let roots = finder(&octic(machine, rho));
            let postures = forward(machine, rho).expect("a reachable joint vector has assembly modes");
            for posture in &postures {
                let t = (0.5 * posture.pose.alpha).tan();
                modes += 1;
                found += usize::from(roots.iter().any(|root| (root - t).abs() <= FOUND * (1.0 + t * t)));
            }
        }
        (found, modes)
    };
    FINDERS
        .iter()
        .map(|&(name, finder)| {
            let (found, modes) = count(finder);
            assert!(10 * found > 9 * modes, "{name}: {found} of {modes} modes: another polynomial?");
            (name, found, modes)
        })
        .collect()
}
