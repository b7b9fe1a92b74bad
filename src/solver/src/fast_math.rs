//! Elementary functions for the inner loops, without calls and almost without branches, so that a processor computes
//! several at once. The standard library's circular functions take two to three times as long because they round the
//! last half unit correctly. No length here needs that.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_2_PI, FRAC_PI_2, PI, TAU};

/// Angle up to which its quarter turns are split off exactly.
pub(crate) const MAX_ANGLE: f64 = 1e5;
/// A quarter of a turn: its first 37 bits, and the rest.
const QUARTER: [f64; 2] = [1.570_796_326_792_333_3, 2.563_344_151_594_519e-12];
/// A constant that, added to a number below 2^51, leaves the nearest integer in the last bits.
const ROUND: f64 = 6_755_399_441_055_744.0;
/// (sin x - x) / x³ and (cos x - 1 + x²/2) / x⁴ in x² up to an eighth of a turn, lowest power first. The relative
/// errors of sin x and cos x are below 4e-18. `tests/python/fit_polynomials.py` derives these minimax polynomials.
const SINE: [[f64; 2]; 3] = [
    [-0.166_666_666_666_666_3, 0.008_333_333_333_321_84],
    [-1.984_126_982_935_852_2e-4, 2.755_731_353_851_109_6e-6],
    [-2.505_073_438_863_349_5e-8, 1.589_543_324_624_660_8e-10],
];
const COSINE: [[f64; 2]; 3] = [
    [0.041_666_666_666_666_595, -0.001_388_888_888_887_334_2],
    [2.480_158_728_900_21e-5, -2.755_731_421_705_158_7e-7],
    [2.087_570_539_866_798_7e-9, -1.135_874_942_048_901_5e-11],
];
/// Numerator and denominator of (asin x - x) / x³ in x² up to 1/2, lowest power first: a rational interpolant in
/// Chebyshev nodes, by the same script. The relative error of asin x is below 6e-17. A polynomial of this precision has
/// 20 coefficients: it needs no division, but a single arc sine takes longer.
const NUMERATOR: [[f64; 2]; 4] = [
    [0.166_666_666_666_666_66, -0.462_188_914_553_837_4],
    [0.466_791_314_679_665_4, -0.204_115_751_138_447_52],
    [0.033_899_997_993_778_415, -0.000_688_446_428_588_090_4],
    [-4.178_063_554_700_246_6e-5, -2.618_761_695_677_644e-6],
];
const DENOMINATOR: [[f64; 2]; 3] = [
    [1.0, -3.223_133_487_323_024],
    [3.983_300_814_516_143, -2.336_132_213_065_277],
    [0.641_021_329_213_771_3, -0.064_428_976_026_783_16],
];

/// The polynomial's value, coefficients in pairs from the lowest power: two short chains of
/// dependent operations in place of a long one.
#[inline(always)]
fn polynomial<const N: usize>(pairs: &[[f64; 2]; N], x: f64) -> f64 {
    let square = x * x;
    let pair = |i: usize| pairs[i][0] + pairs[i][1] * x;
    (0..N - 1).rev().fold(pair(N - 1), |sum, i| sum * square + pair(i))
}

/// sin and cos of an angle, to about a unit in the last place.
#[inline(always)]
pub(crate) fn sin_cos(angle: f64) -> (f64, f64) {
    if angle.abs() < MAX_ANGLE { sin_cos_of_turn(angle) } else { angle.sin_cos() }
}

/// [`sin_cos`] of an angle that is known to be within some turns.
#[inline(always)]
pub(crate) fn sin_cos_of_turn(angle: f64) -> (f64, f64) {
    let shifted = angle * FRAC_2_PI + ROUND;
    let (quarters, count) = (shifted - ROUND, shifted.to_bits());
    let x = (angle - quarters * QUARTER[0]) - quarters * QUARTER[1];
    let square = x * x;
    let sine = x + x * (square * polynomial(&SINE, square));
    let cosine = 1.0 - (0.5 * square - square * square * polynomial(&COSINE, square));
    let (s, c) = if count & 1 == 0 { (sine, cosine) } else { (cosine, sine) };
    // The sine is negative in the third and fourth quarter, the cosine in the second and third.
    let signed = |value: f64, count: u64| f64::from_bits(value.to_bits() ^ ((count & 2) << 62));
    (signed(s, count), signed(c, count.wrapping_add(1)))
}

/// Whether the nearest integer is odd; the number's magnitude is below 2^51.
#[inline]
pub(crate) fn is_odd(number: f64) -> bool {
    (number + ROUND).to_bits() & 1 == 1
}

/// asin x for x² <= 1/2, to about two units in the last place; `square` is x².
#[inline(always)]
pub(crate) fn asin(x: f64, square: f64) -> f64 {
    x + x * (square * polynomial(&NUMERATOR, square) / polynomial(&DENOMINATOR, square))
}

/// The angle of a direction, in (-π, π], from its sine or its cosine, whichever is the steeper
/// function there.
#[inline(always)]
pub(crate) fn angle_of(c: f64, s: f64) -> f64 {
    let steep = if c.abs() > FRAC_1_SQRT_2 { s } else { c };
    let arc = asin(steep, steep * steep);
    let angle = if c > FRAC_1_SQRT_2 {
        arc
    } else if c < -FRAC_1_SQRT_2 {
        (PI - arc.abs()).copysign(s)
    } else {
        (FRAC_PI_2 - arc).copysign(s)
    };
    if angle <= -PI { PI } else { angle }
}

/// An angle that is at most a turn outside (-π, π], shifted into it.
#[inline(always)]
pub(crate) fn wrapped(angle: f64) -> f64 {
    if angle > PI {
        angle - TAU
    } else if angle <= -PI {
        angle + TAU
    } else {
        angle
    }
}

/// The greater of two numbers: a single instruction, unlike `f64::max`, which looks for NaNs.
#[inline(always)]
pub(crate) fn greater(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The lesser of two numbers.
#[inline(always)]
pub(crate) fn lesser(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// The angle of a vector that need not have unit length, in (-π, π]; zero for a vector of no length.
#[inline(always)]
pub(crate) fn angle_of_vector(x: f64, y: f64) -> f64 {
    let length = (x * x + y * y).sqrt();
    if length > 0.0 { angle_of(x / length, y / length) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sines_and_cosines_equal_the_standard_library() {
        for i in -100_000..=100_000 {
            let angle = f64::from(i) * 1.234e-3;
            let ((s, c), (sin, cos)) = (sin_cos(angle), angle.sin_cos());
            assert!((s - sin).abs() <= 2.3e-16 && (c - cos).abs() <= 2.3e-16, "{angle}");
        }
        assert_eq!(sin_cos(0.0), (0.0, 1.0));
        assert!((sin_cos(PI).0 - PI.sin()).abs() < 1e-25);
    }

    #[test]
    fn the_quotient_equals_the_arc_sine() {
        for i in -700..=700 {
            let x = f64::from(i) * 1.01e-3;
            assert!((asin(x, x * x) - x.asin()).abs() <= 4e-16 * x.abs(), "{x}");
        }
    }

    #[test]
    fn every_direction_returns_its_angle() {
        for i in -3141..=3141 {
            let angle = f64::from(i) * 1e-3;
            assert!((angle_of(angle.cos(), angle.sin()) - angle).abs() <= 1e-15, "{angle}");
        }
        assert_eq!(angle_of(-1.0, 0.0), PI);
        assert_eq!(angle_of(-1.0, -0.0), PI);
    }
}
