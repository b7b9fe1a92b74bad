//! The polynomial of degree eight of the forward problem in t = tan(a/2), for general root finders.
//!
//! It is built by convolution from the definition of F, independently of the solver's own elimination.

use verne_solver::Machine;

/// Coefficients, the constant first.
pub(crate) type Octic = [f64; 9];

/// F (1 + t²)⁴ over its largest coefficient.
pub(crate) fn octic(machine: &Machine, rho: [f64; 3]) -> Octic {
    let g = &machine.data().geometry;
    let (e1, e2) = (g.D1 - g.d1, g.D2 - g.d2);
    let gap = rho[2] - rho[1];
    let (a, b) = (rho[0] - rho[1], rho[0] - rho[2]);
    let s = a + b;
    let c = g.R1 * g.R1 + g.r1 * g.r1;
    let k = 2.0 * g.R1 * g.r1;
    let l1_square = g.L1 * g.L1;

    let u = linear(-g.r1, g.R1, 0.0);
    let d = linear(-2.0 * gap * g.r1, 2.0 * gap * g.R1, 4.0 * (g.R2 * g.r1 - g.R1 * g.r4));
    let n = linear((g.L2 + g.L3) * (g.L2 - g.L3) - gap * s, 0.0, 2.0 * g.R2 * s);
    let t0 =
        g.R2 * g.R2 + g.r4 * g.r4 - 0.5 * (g.L2 * g.L2 + g.L3 * g.L3) - c + l1_square + 0.5 * (a * a + b * b)
            - (e1 * e1 - e2 * e2);
    let t = linear(t0, k - 2.0 * g.R2 * g.r4, g.R2 * (b - a));

    let half: Vec<f64> =
        plus(&scaled(s, &times(&u, &n)), &times(&t, &d)).iter().map(|x| x / (2.0 * (e1 - e2))).collect();
    let one = [1.0, 0.0, 1.0];
    let x1_d = plus(&half, &scaled(e1, &times(&d, &one)));
    let (n_square, d_square) = (times(&n, &n), times(&d, &d));
    let with_n = times(&linear(c, -k, 0.0), &n_square);
    let with_d = times(&linear(c - l1_square, -k, 0.0), &d_square);
    let f = plus(&times(&x1_d, &x1_d), &times(&one, &plus(&with_n, &with_d)));
    let largest = f.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    std::array::from_fn(|i| f[i] / largest)
}

/// (constant + cos · cos a + sin · sin a) (1 + t²).
fn linear(constant: f64, cos: f64, sin: f64) -> Vec<f64> {
    vec![constant + cos, 2.0 * sin, constant - cos]
}

fn times(a: &[f64], b: &[f64]) -> Vec<f64> {
    let mut product = vec![0.0; a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            product[i + j] += x * y;
        }
    }
    product
}

fn plus(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(x, y)| x + y).collect()
}

fn scaled(factor: f64, a: &[f64]) -> Vec<f64> {
    a.iter().map(|x| factor * x).collect()
}
