//! Values of a trigonometric polynomial on an equidistant grid.

use std::f64::consts::PI;

use super::polynomial::TrigPolynomial;

/// Nodes in a quarter of the circle.
const QUARTER: usize = 4;
/// Nodes on the circle.
pub(super) const NODES: usize = 4 * QUARTER;
/// Angle between two nodes.
pub(super) const STEP: f64 = 2.0 * PI / 16.0;

const _: () = assert!(NODES == 16);

/// cos and sin of the first quarter's nodes, (j + 1/2) STEP. Multiples follow by recurrence.
const COS: [f64; QUARTER] =
    [0.980_785_280_403_230_4, 0.831_469_612_302_545_2, 0.555_570_233_019_602_2, 0.195_090_322_016_128_27];
const SIN: [f64; QUARTER] =
    [0.195_090_322_016_128_27, 0.555_570_233_019_602_2, 0.831_469_612_302_545_2, 0.980_785_280_403_230_4];

/// cos nθ and sin nθ at the first quarter's nodes, n = 0..=4.
const TABLE: [[[f64; QUARTER]; 2]; 5] = table();

const fn table() -> [[[f64; QUARTER]; 2]; 5] {
    let mut table = [[[0.0; QUARTER]; 2]; 5];
    let mut j = 0;
    while j < QUARTER {
        let (mut c, mut s) = (1.0, 0.0);
        let mut n = 0;
        while n < 5 {
            table[n][0][j] = c;
            table[n][1][j] = s;
            (c, s) = (c * COS[j] - s * SIN[j], s * COS[j] + c * SIN[j]);
            n += 1;
        }
        j += 1;
    }
    table
}

/// The angle of node `i`, from -π + STEP/2 upwards.
#[allow(clippy::cast_precision_loss, reason = "i is below 16")]
pub(super) fn node_angle(i: usize) -> f64 {
    (i as f64 + 0.5) * STEP - PI
}

/// The polynomial at all nodes, in rising order of the angle. 0 and π lie half-way between nodes:
/// the machine's symmetry plane never falls on one.
///
/// The four mirror images of a node share their products: cos nθ and sin nθ only change sign.
#[inline]
pub(super) fn on_grid<const M: usize>(poly: &TrigPolynomial<M>) -> [f64; NODES] {
    // By parity of the degree: [cos even, cos odd, sin even, sin odd].
    let mut parts = [[0.0; QUARTER]; 4];
    for (n, [cos, sin]) in TABLE.iter().enumerate().take(M) {
        let odd = n & 1;
        for j in 0..QUARTER {
            parts[odd][j] += poly.cos[n] * cos[j];
            parts[2 + odd][j] += poly.sin[n] * sin[j];
        }
    }
    let mut values = [0.0; NODES];
    for j in 0..QUARTER {
        let [ce, co, se, so] = [parts[0][j], parts[1][j], parts[2][j], parts[3][j]];
        let half = NODES / 2;
        values[half + j] = (ce + co) + (se + so);
        values[half - 1 - j] = (ce + co) - (se + so);
        values[NODES - 1 - j] = (ce - co) - (se - so);
        values[j] = (ce - co) + (se - so);
    }
    values
}

#[cfg(test)]
mod tests {
    use super::super::polynomial::linear;
    use super::*;

    #[test]
    fn grid_values_equal_the_polynomial() {
        let square = linear(0.3, -1.2, 2.0).times(&linear(1.0, 0.5, -0.25)).squared();
        let poly = square.plus(1.0, &linear(0.2, 0.3, -0.9).raised());
        for (i, value) in on_grid(&poly).into_iter().enumerate() {
            assert!((value - poly.at(node_angle(i)).value).abs() < 1e-13, "node {i}");
        }
    }
}
